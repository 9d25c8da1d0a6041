// SPDX-License-Identifier: Apache-2.0
// `errors propose`: the cheapest configuration that meets the target.
import { stacks } from "../bars";
import { h } from "../dom";
import { figures_of, number_text } from "../figures";
import type { Panel, Result } from "../page";
import { cell, cost_unit, lead, note, tiles } from "../parts";
import { legend } from "../svg";
import { table } from "../table";

const kinds: [key: string, name: string, colour: string][] = [
  ["storage_bits", "storage", "c0"],
  ["adder_bits", "adders", "c2"],
  ["multiplier_bits", "multipliers", "c1"],
];

export const propose: Panel = {
  name: "propose",
  verbs: ["errors propose"],
  title: "Proposed configuration",
  about: "The cheapest that meets the target, and each key. Cost is in full adders; a bit of memory is a sixth.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const devices = result.speed?.proposed?.devices;
    const share = result.cost.total / result.cost_from.total;
    root.append(
      lead(
        result.met ? "pass" : "fail",
        h("code", {}, result.target),
        result.met ? (devices ? ` is met by ${devices} device${devices > 1 ? "s" : ""}: ` : ` is met at ${number_text(100 * share, { digits: 0 })} % of the cost: `) : " is not met by any tried: ",
        "PSNR ",
        show(["error_from", "psnr_db"], { digits: 2 }),
        " \u2192 ",
        show(["error", "psnr_db"], { digits: 2, unit: "dB" }),
        ", cost ",
        show(["cost_from", "total"], { digits: 0 }),
        " \u2192 ",
        show(["cost", "total"], { digits: 0, unit: cost_unit }),
        ".",
      ),
      note([...(result.scenes ?? []), `from ${result.from?.name} ${result.from?.hash}`].join("; ")),
      tiles(
        ["Configurations judged", show(["judged"])],
        ["Frames simulated", show(["simulated"])],
        ["RMS", show(["error", "rms_lsb8"]), h("small", {}, " LSB8")],
        ["Worst", show(["error", "max_lsb8"]), h("small", {}, " LSB8")],
      ),
    );
    const place = cell(root);
    const percent = (key: string): number => (100 * result.cost[key]) / (result.cost_from[key] || 1);
    stacks(
      place,
      { title: "What is left of each part", about: "proposed, of what there was", label: kinds.map(([key, name]) => `${name} ${number_text(percent(key))} %`).join(", "), unit: "%", most: Math.max(100, ...kinds.map(([key]) => percent(key))) },
      [...kinds, ["total", "cost", "c7"] as const].map(([key, name, colour]) => ({
        name,
        shown: `${number_text(percent(key), { digits: 1 })} %`,
        parts: [{ name, value: percent(key), colour, tip: `${name}: ${number_text(result.cost_from[key], { digits: 0 })} \u2192 ${number_text(result.cost[key], { digits: 0 })} ${key === "total" ? cost_unit : "bits"}` }],
      })),
    );
    place.append(legend(kinds.map(([, name, colour]) => ({ name: `${name}, bits`, colour }))));
    const speed = result.speed;
    if (speed) {
      const numbers = (names: Record<string, string>) =>
        Object.entries(names).map(([key, name]) => ({
          name,
          value: (row: Result) => key.split(".").reduce((of, part) => of[part], row),
          figure: (row: Result) => `${context.index}.speed.${row.at}.${key}`,
        }));
      table(root, {
        label: `Devices at ${speed.clock_mhz} MHz`,
        rows: [{ at: "from", ...speed.from }, { at: "proposed", ...speed.proposed }, ...speed.others.map((row: Result, i: number) => ({ at: `others.${i}`, ...row }))].filter((row) => row.devices),
        columns: [
          { name: "Area", value: (row) => (row.target_fps ? `${row.target_fps} fps` : row.at) },
          ...numbers({ devices: "Devices", fps: "fps", milliseconds: "ms" }),
          { name: "Lanes", value: (row) => row.array_lanes ** 2 },
          { name: "At once", value: (row) => row.composited_at_once },
          { name: "Tile", value: (row) => `${row.tile_width} x ${row.tile_height}` },
          { name: "Culls", value: (row) => row.cull_map },
          ...numbers({ "area.lut": "LUT", "area.ff": "FF", "area.ramb36": "RAMB36", "area.dsp": "DSP", "area.equivalent_luts": "LUTs, all" }),
        ],
      });
    }
    table(root, {
      label: "Keys",
      rows: result.keys as Result[],
      columns: [
        { name: "Key", value: (row) => row.key },
        { name: "From", value: (row) => row.from },
        { name: "Alone", value: (row) => row.alone },
        { name: "Proposed", value: (row) => row.proposed, kind: (row) => (row.proposed !== row.from ? "changed" : "") },
        { name: "One less", value: (row) => row.lower },
        { name: "gives", unit: "times the error allowed", value: (row) => row.excess_if_lower, style: { digits: 3 }, figure: (row) => `${context.index}.keys.${result.keys.indexOf(row)}.excess_if_lower` },
      ],
    });
  },
};
