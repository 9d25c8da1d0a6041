// SPDX-License-Identifier: Apache-2.0
// Cycles of a frame, with the ideal and each loss, and frames per second at a clock.
import { waterfall } from "../../../report/web/src/bars";
import { clear, h } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import { tiles } from "../../../report/web/src/parts";

export interface Cycles {
  actual: number;
  idle: number;
  end: number;
  bytes_in: number;
  bytes_out: number;
  account: Record<string, number>;
}

const meanings: Record<string, string> = {
  ideal: "ideal",
  records: "records",
  table_load: "loading tables",
  hidden: "hidden splats",
  input: "waiting for input",
  sheet_buffer: "waiting for a sheet buffer",
  map: "cull map",
  hazard: "waiting for an overlapping window",
  drain: "emptying the pipeline",
  pixels: "writing pixels",
  output: "waiting for output",
};

export class CyclesPart {
  readonly root: HTMLElement;
  private readonly lines = h("div", { "aria-live": "off" });
  private readonly chart = h("div", { class: "solo" });
  private readonly clock = h("input", { type: "number", id: "clock", min: 0.001, max: 100000, step: "any", value: 100, input: () => this.draw() });
  private cycles: Cycles | null = null;

  constructor() {
    this.root = h("section", { class: "box", id: "cycles", "aria-labelledby": "cycles-title" }, h("h2", { id: "cycles-title" }, "Cycles"), h("div", { class: "entry" }, h("label", { for: "clock" }, "Clock in MHz"), this.clock), this.lines, this.chart);
  }

  wait(): void {
    this.root.classList.add("stale");
  }

  fail(message: string): void {
    this.cycles = null;
    this.root.classList.remove("stale");
    clear(this.chart);
    this.lines.replaceChildren(h("p", { class: "note" }, message));
  }

  show(cycles: Cycles): void {
    this.cycles = cycles;
    this.root.classList.remove("stale");
    this.draw();
    clear(this.chart);
    const { ideal, ...losses } = cycles.account;
    const share = (value: number): string => `${number_text((100 * value) / Math.max(1, cycles.actual), { digits: 2 })} %`;
    const falls = Object.entries(losses).filter(([, value]) => value > 0);
    const all = [["ideal", ideal] as const, ...falls];
    // The ideal part would reduce small losses to hairlines, so the axis begins within it.
    const lost = cycles.actual - ideal;
    waterfall(
      this.chart,
      {
        title: "Where the cycles go",
        about: "ideal: one for each window; then each loss",
        label: all.map(([name, value]) => `${meanings[name] ?? name}: ${value}`).join(", "),
        unit: "cycles",
        from: lost < 0.1 * ideal ? Math.max(0, ideal - 1.5 * lost) : undefined,
      },
      [
        ...all.map(([name, value], i) => ({ name: meanings[name] ?? name, value, shown: number_text(value), tip: `${meanings[name] ?? name}: ${number_text(value)} cycles, ${share(value)}`, total: i === 0, colour: i === 0 ? "c0" : "c3" })),
        { name: "actual", value: cycles.actual, shown: number_text(cycles.actual), tip: `actual: ${number_text(cycles.actual)} cycles`, total: true },
      ],
    );
  }

  private draw(): void {
    const { cycles } = this;
    if (!cycles) return;
    const mhz = Number(this.clock.value);
    const fps = mhz > 0 ? (mhz * 1e6) / cycles.end : Number.NaN;
    this.lines.replaceChildren(
      tiles(
        ["Cycles, busy", h("span", { id: "cycles-actual" }, number_text(cycles.actual))],
        ["Ideal", number_text(cycles.account.ideal)],
        ["Lost", number_text(cycles.actual - cycles.account.ideal), h("small", {}, ` ${number_text((100 * (cycles.actual - cycles.account.ideal)) / Math.max(1, cycles.actual), { digits: 2 })} %`)],
        ["From first to last", number_text(cycles.end)],
        [`Frames a second at ${number_text(mhz)} MHz`, h("span", { id: "fps" }, number_text(fps))],
        ["Milliseconds a frame", number_text(1000 / fps)],
        ["Bytes a frame", h("span", { id: "bytes" }, number_text(cycles.bytes_in + cycles.bytes_out)), h("small", {}, ` stream ${number_text(cycles.bytes_in)}, pixels ${number_text(cycles.bytes_out)}`)],
      ),
    );
  }
}
