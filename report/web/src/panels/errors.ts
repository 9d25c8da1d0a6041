// SPDX-License-Identifier: Apache-2.0
// `errors`: which steps cause the device picture's error.
import { waterfall } from "../bars";
import { h } from "../dom";
import { figures_of, number_text } from "../figures";
import type { Panel, Result } from "../page";
import { cell, cost_unit, grid, lead, made_of, note, tiles } from "../parts";
import { legend } from "../svg";
import { numbers_of, table } from "../table";

function steps(root: HTMLElement, result: Result): void {
  const total = result.total.rms_lsb8 ** 2;
  const shares = result.steps.map((step: Result) => step.share as number);
  waterfall(
    root,
    {
      title: "Steps, in the chain's order",
      about: "share of the squared error that comes in with each; they add up to all of it",
      label: `Waterfall of the steps' shares: ${result.steps.map((step: Result) => `${step.name} ${number_text(100 * step.share, { digits: 1 })} %`).join(", ")}`,
      unit: "% of the squared error",
    },
    [
      ...result.steps.map((step: Result) => ({
        name: step.name,
        value: 100 * step.share,
        shown: `${number_text(100 * step.share, { digits: 1, sign: true })} %`,
        tip: `${step.name} (${step.by}): ${step.meaning}; ${number_text(100 * step.share, { digits: 2 })} %${step.keys && `, ${step.keys}`}`,
        colour: step.by === "driver" ? "c0" : step.by === "device" ? "c1" : "c4",
      })),
      {
        name: "all",
        value: 100 * shares.reduce((sum: number, share: number) => sum + share, 0),
        shown: `${number_text(100 * shares.reduce((sum: number, share: number) => sum + share, 0), { digits: 1 })} %`,
        tip: `all steps: RMS ${number_text(Math.sqrt(total))} LSB of 8 bits`,
        total: true,
      },
    ],
  );
}

/** The parts of one pixel's error: the largest ones, and the rest. */
function pixel(root: HTMLElement, entry: Result): void {
  const parts = Object.entries(entry.parts_lsb8 as Record<string, number>).sort((a, b) => Math.abs(b[1]) - Math.abs(a[1]));
  const large = parts.slice(0, 5);
  const rest = parts.slice(5).reduce((sum, [, value]) => sum + value, 0);
  const where = `pixel (${entry.x}, ${entry.y}) ${"RGBA"[entry.channel] ?? entry.channel}`;
  const row = (name: string, value: number, total = false): Parameters<typeof waterfall>[2][number] => ({
    name,
    value,
    total,
    shown: number_text(value, { digits: 3, sign: true }),
    tip: `${name}: ${number_text(value, { sign: true })} LSB of 8 bits`,
  });
  waterfall(
    root,
    {
      title: `${entry.which === "p90" ? "90 %" : entry.which[0].toUpperCase() + entry.which.slice(1)} ${where}`,
      label: `Parts of ${where}: ${large.map(([name, value]) => `${name} ${number_text(value)}`).join(", ")}`,
      unit: "LSB of 8 bits",
    },
    [...large.map(([name, value]) => row(name, value)), row("others", rest), row("error", entry.error_lsb8, true)],
  );
}

export const errors: Panel = {
  name: "errors",
  verbs: ["errors"],
  title: "Error by step",
  about: "Which step of the arithmetic causes how much of the error against golden. LSB8: a step of an 8-bit pixel, 1/255.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const place = (row: Result): number => result.steps.indexOf(row);
    const most = result.steps.reduce((best: Result, step: Result) => (step.share > best.share ? step : best), result.steps[0]);
    root.append(
      most && most.share > 0
        ? lead(
            null,
            h("strong", {}, most.name),
            ` (${most.meaning}) brings `,
            show(["steps", place(most), "share"], { scale: 100, digits: 0, unit: "%" }),
            " of the squared error; all steps together: RMS ",
            show(["total", "rms_lsb8"], { unit: "LSB" }),
            ", worst ",
            show(["total", "max_lsb8"], { unit: "LSB of 8 bits" }),
            ".",
          )
        : lead(null, "No step errs."),
      note(made_of(result), result.floats && `; floats: ${result.floats.operands}, sums ${result.floats.sums}, centres in the ${result.floats.centres}`),
      tiles(
        ["Driver's part", show(["driver_share"], { scale: 100, digits: 1, unit: "%" })],
        ["Device's part", show(["device_share"], { scale: 100, digits: 1, unit: "%" })],
        ["RMS", show(["total", "rms_lsb8"]), h("small", {}, " LSB8")],
        ["Rounding to 8 bits alone", show(["floor_8", "rms_lsb8"]), h("small", {}, " LSB8")],
        ["Bias", show(["total", "bias_lsb8"], { sign: true }), h("small", {}, " LSB8")],
        ["Frames drawn", show(["frames"])],
      ),
    );
    if (result.remedy)
      root.append(
        h(
          "p",
          {},
          "Remedy: ",
          h("code", {}, result.remedy.changes),
          " takes the RMS from ",
          show(["total", "rms_lsb8"]),
          " to ",
          show(["remedy", "error", "rms_lsb8"]),
          " LSB8; the cost goes from ",
          show(["remedy", "cost_before", "total"], { digits: 0 }),
          " to ",
          show(["remedy", "cost_after", "total"], { digits: 0, unit: cost_unit }),
          " (a bit of memory is a sixth of one).",
        ),
      );
    const parts = grid(root);
    const chain = cell(parts);
    steps(chain, result);
    const by = result.floats ? [["float", "c4"]] : [["driver", "c0"], ["device", "c1"]];
    chain.append(legend([...by, ["sum", "c7"]].map(([name, colour]) => ({ name, colour }))));
    const pixels = cell(parts);
    for (const entry of result.pixels ?? []) pixel(pixels, entry);
    const alone = result.steps.some((step: Result) => typeof step.alone_share === "number");
    root.append(
      h("h3", {}, alone ? "Each step in the chain, alone, and left out" : "Each step in the chain"),
      note(
        "Share of the squared error; RMS, max and bias of what the step adds; pixels in which it is the largest part.",
        alone ? " Alone: the error with this step's arithmetic only. Left out: the error without it." : " Steps alone and left out were not measured (--quick).",
      ),
    );
    const number = numbers_of(`${context.index}.steps`, result.steps);
    const percent = { scale: 100, digits: 2 };
    table(root, {
      label: "Steps",
      rows: result.steps as Result[],
      columns: [
        { name: "Step", value: (row) => row.name },
        { name: "By", value: (row) => row.by },
        number("Share", "share", "%", percent),
        number("RMS", "increment.rms_lsb8", "LSB8", { digits: 4 }),
        number("Max", "increment.max_lsb8", "LSB8", { digits: 3 }),
        number("Bias", "increment.bias_lsb8", "LSB8", { digits: 4, sign: true }),
        number("Alone", "alone_share", "%", percent),
        number("Left out", "left_out.rms_lsb8", "LSB8", { digits: 4 }),
        number("Rules pixels", "pixels_ruled", "%", { scale: 100, digits: 1 }),
        { name: "Keys", value: (row) => row.keys },
      ],
    });
  },
};
