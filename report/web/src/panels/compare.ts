// SPDX-License-Identifier: Apache-2.0
// `compare`: the difference of two pictures, beside the error of rounding once (the floor).
import { columns } from "../bars";
import { h, type Child } from "../dom";
import { figures_of, number_text, tick_text } from "../figures";
import type { Panel, Result } from "../page";
import { cell, grid, lead, note, tiles } from "../parts";
import { linear } from "../scales";
import { axis_left, drawing, legend, line, text } from "../svg";
import { table } from "../table";

/** Names of `compare`'s limits, with their units. */
const limits: Record<string, string> = {
  min_psnr_db: "PSNR in dB, at least",
  max_abs_lsb: "worst in LSB, at most",
  max_mean_lsb: "mean in LSB, at most",
  max_rmse_lsb: "RMS in LSB, at most",
  max_bias_lsb: "bias in LSB, at most",
  max_p99_lsb: "99 % in LSB, at most",
  min_ssim: "SSIM, at least",
  min_values: "values, at least",
  max_nonfinite: "not finite, at most",
};

const kinds = ["p50", "p90", "p95", "p99", "p99.9", "p99.99"];

function name_of(side: Result): string {
  return String(side?.file ?? "").replace(/^.*\//, "");
}

/** Explains the floor, and why a picture can be nearer to the reference than the floor. */
function floor(result: Result, show: ReturnType<typeof figures_of>): Child[] {
  if (!result.floor || typeof result.floor.psnr_db !== "number") return [];
  const better = typeof result.psnr_db === "number" && result.psnr_db > result.floor.psnr_db;
  return [
    "The floor, ",
    show(["floor", "psnr_db"], { digits: 2, unit: "dB" }),
    `, is no limit: it is what the first picture would lose if it were only rounded to ${result.lsb_bits} bits. `,
    better ? `The second picture is nearer than that because it is stored in steps finer than ${result.lsb_bits} bits.` : "",
  ];
}

function percentiles(root: HTMLElement, result: Result): void {
  const measured = [...kinds.map((kind) => result.percentiles_lsb?.[kind]), result.max_abs_lsb];
  const floor = [...kinds.map((kind) => result.floor?.percentiles_lsb?.[kind]), result.floor?.max_abs_lsb];
  const names = ["50 %", "90 %", "95 %", "99 %", "99.9 %", "99.99 %", "all"];
  drawing(
    root,
    {
      title: "Percentiles of |error|",
      about: `in LSB of ${result.lsb_bits} bits: so many of the values err by no more`,
      label: `Percentiles: ${names.map((name, i) => `${name} at most ${number_text(measured[i])}`).join(", ")}`,
    },
    (to) => {
      const [left, height, bottom] = [46, 210, 176];
      to.height(height);
      const most = Math.max(1e-9, ...[...measured, ...floor].filter((value) => typeof value === "number"));
      const scale = linear(0, most * 1.05, bottom, 8, 5);
      axis_left(to, scale, left, to.width);
      const step = (to.width - left - 30) / (names.length - 1);
      const place = (i: number): number => left + 12 + i * step;
      names.forEach((name, i) => {
        if (step > 48 || i % 2 === 0) to.svg.append(text(place(i), bottom + 18, name, { class: "tick", "text-anchor": "middle" }));
      });
      const draw = (values: (number | null | undefined)[], colour: string, dashed: boolean, what: string): void => {
        values.forEach((value, i) => {
          if (typeof value !== "number") return;
          const before = values[i - 1];
          if (i > 0 && typeof before === "number")
            to.svg.append(
              line(place(i - 1), scale(before), place(i), scale(value), {
                stroke: `var(--${colour})`,
                "stroke-width": 2,
                ...(dashed ? { "stroke-dasharray": "5 4" } : {}),
              }),
            );
          const dot = document.createElementNS("http://www.w3.org/2000/svg", "circle");
          for (const [key, given] of Object.entries({ cx: place(i), cy: scale(value), r: 4, fill: `var(--${colour})` })) dot.setAttribute(key, String(given));
          to.svg.append(dot);
          to.tip(dot, `${what}: ${names[i]} at most ${number_text(value)} LSB`, true);
        });
      };
      draw(floor, "c1", true, "floor");
      draw(measured, "c0", false, "measured");
      to.svg.append(line(left, bottom, to.width, bottom, { class: "axis" }));
    },
  );
  root.append(legend([{ name: "measured", colour: "c0" }, { name: "floor: the first picture rounded once to this LSB", colour: "c1" }]));
}

export function histogram(root: HTMLElement, result: Result): void {
  const bins: { from_lsb: number; to_lsb: number | null; count: number }[] = result.histogram ?? [];
  const total = bins.reduce((sum, bin) => sum + bin.count, 0);
  columns(
    root,
    {
      title: "Histogram of |error|",
      about: `values by LSB, on a logarithmic axis${bins.some((bin) => bin.from_lsb >= 1) ? "; other colour: 1 LSB or more" : ""}`,
      label: `Histogram: ${bins.map((bin) => `${bin.count} values from ${bin.from_lsb} LSB`).join(", ")}`,
      unit: "values",
      x_name: "|error| in LSB, from",
      logs: true,
    },
    bins.map((bin) => ({
      name: tick_text(bin.from_lsb),
      value: bin.count,
      tip: `${number_text(bin.from_lsb)} to ${bin.to_lsb === null ? "\u221e" : number_text(bin.to_lsb)} LSB: ${number_text(bin.count)} values, ${number_text((100 * bin.count) / Math.max(1, total))} %`,
      colour: bin.from_lsb >= 1 ? "c3" : "c0",
    })),
  );
}

export const compare: Panel = {
  name: "compare",
  verbs: ["compare"],
  title: (result) => `Difference: ${name_of(result.ref) || "reference"} and ${name_of(result.test) || "picture"}`,
  about: (result) => `How far the second picture is from the first. LSB: a step of a pixel of ${result.lsb_bits} bits, 1/${number_text(2 ** result.lsb_bits - 1)} of full brightness.`,
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const failed = (result.limits ?? []).filter((limit: Result) => !limit.ok);
    root.append(
      result.identical
        ? lead(result.verdict, "The pictures are identical: all ", show(["values"]), " values.")
        : lead(
            result.verdict,
            "PSNR ",
            show(["psnr_db"], { digits: 2, unit: "dB" }),
            ", no value errs by more than ",
            show(["max_abs_lsb"], { digits: 3, unit: "LSB" }),
            failed.length ? `; ${failed.length === 1 ? "a limit is" : `${failed.length} limits are`} not met` : null,
            ".",
          ),
      tiles(
        ["Mean |error|", show(["mean_abs_lsb"]), h("small", {}, " LSB")],
        ["RMS", show(["rmse_lsb"]), h("small", {}, " LSB")],
        ["Bias", show(["bias_lsb"], { sign: true }), h("small", {}, " LSB")],
        ["99 %", show(["p99_lsb"]), h("small", {}, " LSB")],
        ["SSIM (1: identical)", show(["ssim"], { digits: 6 })],
        ["Values compared", show(["values"])],
        (result.nonfinite?.ref > 0 || result.nonfinite?.test > 0) && ["Not finite", show(["nonfinite", "ref"]), " and ", show(["nonfinite", "test"])],
      ),
    );
    if (!result.identical) root.append(note(floor(result, show)));
    const parts = grid(root);
    histogram(cell(parts), result);
    if (!result.identical) percentiles(cell(parts), result);
    if (result.worst && !result.identical)
      root.append(
        note(
          "Worst value: pixel (",
          show(["worst", "x"]),
          ", ",
          show(["worst", "y"]),
          `), channel ${"RGBA"[result.worst.channel] ?? result.worst.channel}: `,
          show(["worst", "ref"]),
          " and ",
          show(["worst", "test"]),
          " of 1, ",
          show(["worst", "error_lsb"], { sign: true, unit: "LSB" }),
          ". ",
          result.clusters?.length
            ? `${number_text(result.clusters.length)} clusters of pixels err by ${number_text(result.cluster_threshold_lsb)} LSB or more.`
            : `No pixel errs by ${number_text(result.cluster_threshold_lsb)} LSB or more.`,
        ),
      );
    if (result.all_black) root.append(note(String(result.all_black)));
    if (result.limits?.length) {
      root.append(h("h3", {}, "Limits"));
      table(root, {
        label: "Limits",
        columns: [
          { name: "Limit", value: (row: Result) => limits[row.name] ?? row.name.replaceAll("_", " ") },
          { name: "allowed", value: (row: Result) => row.limit, figure: (row: Result) => `${context.index}.limits.${result.limits.indexOf(row)}.limit` },
          { name: "got", value: (row: Result) => row.got, figure: (row: Result) => `${context.index}.limits.${result.limits.indexOf(row)}.got` },
          { name: "Verdict", value: (row: Result) => (row.ok ? "\u2713 met" : "\u2717 not met"), kind: (row: Result) => (row.ok ? "pass" : "fail") },
        ],
        rows: result.limits,
      });
    }
  },
};
