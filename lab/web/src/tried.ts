// SPDX-License-Identifier: Apache-2.0
// Every configuration that was tried with a scene: a point of error over cost, the Pareto front, and a table. Points and
// rows lead back to their configuration.
import { plot, type Line, type Plot } from "../../../report/web/src/charts";
import { clear, h } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import { cost_unit } from "../../../report/web/src/parts";
import { table } from "../../../report/web/src/table";
import type { Shown } from "./drawer";
import type { Lab } from "./lab_state";
import { scene_key } from "./requests";

export interface Trial {
  scene: string;
  lab: Lab;
  name: string;
  hash: string;
  cost: number | null;
  psnr: number | null;
  max: number | null;
  cycles: number | null;
}

/** Trials that no other one beats in both cost and error, cheapest first. */
export function front_of(trials: Trial[]): Trial[] {
  const sorted = trials.filter((each) => each.cost !== null && each.psnr !== null).sort((a, b) => (a.cost as number) - (b.cost as number) || (b.psnr as number) - (a.psnr as number));
  let best = -Infinity;
  return sorted.filter((each) => {
    const better = (each.psnr as number) > best;
    best = Math.max(best, each.psnr as number);
    return better;
  });
}

export class Tried {
  readonly root: HTMLElement;
  private readonly all: Trial[] = [];
  private readonly place = h("div", { class: "solo" });
  private readonly rows = h("div");
  private readonly about = h("p", { class: "note" });
  private drawn: Plot | null = null;
  private shown: Trial[] = [];
  private front: Trial[] = [];
  private now = "";

  constructor(private readonly choose: (lab: Lab) => void) {
    this.root = h("section", { class: "box", id: "tried", "aria-labelledby": "tried-title" }, h("h2", { id: "tried-title" }, "Configurations tried"), this.about, this.place, this.rows);
  }

  add({ lab, frame }: Shown): void {
    const scene = scene_key(lab);
    const { hash, name, cost } = frame.config;
    const { compare } = frame;
    let trial = this.all.find((each) => each.scene === scene && each.hash === hash);
    if (compare && !trial) {
      const keys = Object.entries(lab.changes).map(([key, value]) => `${key}=${value}`);
      trial = { scene, lab, name: [lab.toml ? name : lab.config, ...keys].join(" "), hash, cost: cost?.total ?? null, psnr: typeof compare.psnr_db === "number" ? compare.psnr_db : null, max: compare.max_abs_lsb ?? null, cycles: null };
      this.all.push(trial);
    }
    this.now = trial?.hash ?? "";
    this.draw(scene);
  }

  add_cycles(lab: Lab, hash: string, cycles: number): void {
    const trial = this.all.find((each) => each.scene === scene_key(lab) && each.hash === hash);
    if (!trial || trial.cycles === cycles) return;
    trial.cycles = cycles;
    this.draw(trial.scene);
  }

  private draw(scene: string): void {
    this.shown = this.all.filter((each) => each.scene === scene);
    this.front = front_of(this.shown);
    const point = (each: Trial): [number, number | null] => [each.cost as number, each.psnr];
    const plotted = this.shown.filter((each) => each.cost !== null && each.psnr !== null);
    const now = plotted.filter((each) => each.hash === this.now);
    const lines: Line[] = [
      { name: "front", colour: "c2", points: this.front.map(point) },
      { name: "tried", colour: "c0", points: plotted.map(point), dots: true, size: 8 },
      { name: "shown now", colour: "c3", points: now.map(point), dots: true, diamond: true },
    ];
    const label = `PSNR over cost of ${plotted.length} configurations; the table below has them`;
    this.about.textContent = `${this.shown.length} with this scene and size, ${this.front.length} on the Pareto front (green). Click a point or a row to return to it.`;
    if (plotted.length === 0) clear(this.place), (this.drawn = null);
    else if (this.drawn) this.drawn.update(lines, { label });
    else this.drawn = plot(this.place, { label, x: { name: `cost, ${cost_unit}`, log: true }, y: { name: "PSNR, dB" }, height: 260, picked: ({ line, at }) => this.pick([this.front, plotted_now(this.shown), plotted_now(this.shown).filter((each) => each.hash === this.now)][line]?.[at]) }, lines);
    clear(this.rows);
    if (this.shown.length === 0) return;
    table(this.rows, {
      label: "Configurations tried",
      rows: this.shown,
      sort: 2,
      chosen: (row) => row.hash === this.now,
      choose: (row) => this.pick(row),
      columns: [
        { name: "Configuration", value: (row) => row.name, kind: () => "wrap" },
        { name: "Cost", unit: cost_unit, value: (row) => row.cost },
        { name: "PSNR", unit: "dB", value: (row) => row.psnr, style: { digits: 2 } },
        { name: "Max", unit: "LSB", value: (row) => row.max, style: { digits: 3 } },
        { name: "Cycles", value: (row) => row.cycles },
        { name: "Front", value: (row) => (this.front.includes(row) ? "yes" : "") },
        { name: "Hash", value: (row) => row.hash, cell: (row) => h("code", { title: number_text(row.cost) }, row.hash) },
      ],
    });
  }

  private pick(trial: Trial | undefined): void {
    if (trial) this.choose(trial.lab);
  }
}

const plotted_now = (trials: Trial[]): Trial[] => trials.filter((each) => each.cost !== null && each.psnr !== null);
