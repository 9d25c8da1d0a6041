// SPDX-License-Identifier: Apache-2.0
// `family`: errors and cost of every index kind.
import { line_legend, plot, type Line, type Plot } from "../charts";
import { h } from "../dom";
import { number_text } from "../figures";
import type { Panel, Result } from "../page";
import { cell, grid, lead, note } from "../parts";
import { series_colours } from "../theme";
import { table } from "../table";

const metrics: [name: string, title: string, value: (row: Result) => number][] = [
  ["aligned.rms", "RMS, aligned lattice", (row) => row.aligned?.rms],
  ["aligned.max", "max, aligned lattice", (row) => row.aligned?.max],
  ["turned.rms", "RMS, turned lattice", (row) => row.turned?.rms],
  ["turned.max", "max, turned lattice", (row) => row.turned?.max],
];
const dashes = [undefined, [7, 4], [2, 3], [9, 3, 2, 3], [4, 2], [12, 4], [1, 4], [6, 2, 2, 2, 2, 2]];

function unique(values: (number | undefined)[]): number[] {
  return [...new Set(values.filter((value): value is number => typeof value === "number"))].sort((a, b) => a - b);
}

function select(label: string, values: (string | number)[], chosen: string | number, changed: () => void, names?: string[]): { element: HTMLElement; value: () => string } {
  const list = h("select", { change: changed }, values.map((value, i) => h("option", { value, selected: value === chosen }, names?.[i] ?? String(value))));
  return { element: h("label", {}, `${label} `, list), value: () => list.value };
}

export const family: Panel = {
  name: "family",
  verbs: ["family"],
  title: "Family of indices",
  of: "kinds of index; of no scan and no picture",
  about: "How exactly each kind of index finds a splat's weights, and what it costs.",
  render(root, result, context) {
    const cells: Result[] = result.cells ?? [];
    const kinds = [...new Set(cells.map((row) => row.kind as string))];
    const radii = unique(cells.map((row) => row.radius));
    const grids = unique(cells.map((row) => row.grid));
    const entries = unique(cells.map((row) => row.entries));
    const unit = String(result.unit ?? "1/255 of the mean");
    const best = cells.filter((row) => typeof row.aligned?.rms === "number").sort((a, b) => a.aligned.rms - b.aligned.rms)[0];
    root.append(
      best
        ? lead(null, `${number_text(cells.length)} cells of ${kinds.length} ${kinds.length === 1 ? "kind" : "kinds"}; least error of an aligned lattice: `, h("strong", {}, best.kind), ` with K = ${best.grid}${best.entries ? `, N = ${best.entries}` : ""}: RMS `, h("span", { class: "figure", "data-figure": `${context.index}.cells.${cells.indexOf(best)}.aligned.rms` }, number_text(best.aligned.rms)), ` (${unit}), ${number_text(best.bits)} bits.`)
        : lead(null, "There is no cell in this result."),
      note(`Errors in units of ${unit} weight. Radius: of the footprint, in pixels. K: steps of the centres' grid a pixel; N: entries of a table.`),
    );
    if (!best) return;
    const again = (): void => draw();
    const radius = select("Radius", radii, radii[Math.floor(radii.length / 2)], again);
    const metric = select("Error", metrics.map(([name]) => name), "turned.rms", again, metrics.map(([, title]) => title));
    const at_n = select("N", entries, entries.includes(512) ? 512 : (entries[entries.length - 1] ?? 0), again);
    const at_k = select("K", grids, grids.includes(16) ? 16 : (grids[grids.length - 1] ?? 0), again);
    root.append(h("div", { class: "controls" }, radius.element, metric.element, at_n.element, at_k.element));
    const parts = grid(root);
    const frame = (title: string): HTMLElement => {
      const figure = h("figure", {}, h("figcaption", {}, h("strong", {}, title)));
      cell(parts).append(figure);
      return figure;
    };
    const frames = [frame("Error over K"), frame("Error over N"), frame("Error over table bits"), frame("Error over cycles of a splat")];
    const plots: (Plot | null)[] = [null, null, null, null];
    const key = h("div");
    root.append(key);

    function draw(): void {
      const [, title, value] = metrics.find(([name]) => name === metric.value()) ?? metrics[0];
      const mine = cells.filter((row) => row.radius === Number(radius.value()) && value(row) > 0);
      const lines = (x: (row: Result) => number, keep: (row: Result) => boolean, dots: boolean): Line[] =>
        kinds.map((kind, i) => ({
          name: kind,
          colour: series_colours[i % series_colours.length],
          dash: dashes[i % dashes.length],
          dots,
          size: 6,
          points: mine
            .filter((row) => row.kind === kind && keep(row) && x(row) > 0)
            .map((row): [number, number] => [x(row), value(row)])
            .sort((a, b) => a[0] - b[0]),
        }));
      const n = Number(at_n.value());
      const k = Number(at_k.value());
      const all: [string, number[] | undefined, Line[]][] = [
        ["K", grids, lines((row) => row.grid, (row) => row.entries === undefined || row.entries === n, false)],
        ["N", entries, lines((row) => row.entries, (row) => row.grid === k, false)],
        ["bits", undefined, lines((row) => row.bits, () => true, true)],
        ["cycles of a splat", undefined, lines((row) => row.cycles, () => true, true)],
      ];
      all.forEach(([name, ticks, drawn], i) => {
        const settings = { label: `${title} over ${name}, a line for each of ${kinds.join(", ")}`, x: { name: i < 2 ? `${name}, ${i ? "entries" : "steps a pixel"}` : name, log: true, ticks }, y: { name: `${title}, ${unit}`, log: true }, height: 240 };
        if (plots[i]) plots[i]?.update(drawn, settings);
        else plots[i] = plot(frames[i], settings, drawn);
      });
      key.replaceChildren(line_legend(all[0][2]));
    }
    draw();
    const figure = (...path: string[]) => (row: Result) => [context.index, "cells", cells.indexOf(row), ...path].join(".");
    table(root, {
      label: "Cells",
      filter: true,
      rows: cells,
      columns: [
        { name: "Kind", value: (row) => row.kind },
        { name: "Radius", unit: "pixels", value: (row) => row.radius, figure: figure("radius") },
        { name: "K", value: (row) => row.grid, figure: figure("grid") },
        { name: "N", value: (row) => row.entries },
        ...metrics.map(([name, title, value]) => ({ name: title, unit, value, style: { digits: 3 }, figure: figure(...name.split(".")) })),
        { name: "Bits", value: (row: Result) => row.bits, figure: figure("bits") },
        { name: "Adds", unit: "per pixel", value: (row: Result) => row.adds },
        { name: "Multiplies", unit: "per pixel", value: (row: Result) => row.multiplies },
        { name: "Reads", unit: "per pixel", value: (row: Result) => row.reads },
        { name: "Cycles", unit: "per splat", value: (row: Result) => row.cycles, figure: figure("cycles") },
        { name: "Remarks", value: (row: Result) => (row.remarks ?? []).join(", ") },
      ],
    });
  },
};
