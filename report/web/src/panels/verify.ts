// SPDX-License-Identifier: Apache-2.0
// `verify`: comparison of the RTL with the model, and its history over results and seeds.
import { columns, stacks } from "../bars";
import { command_button, h } from "../dom";
import { number_text, path_text } from "../figures";
import type { Item, Panel, Result } from "../page";
import { cell, grid, lead, note, tiles } from "../parts";
import { table } from "../table";

const status = (verdict: string): string => (verdict === "pass" ? "pass" : "fail");
const seeds = (result: Result): string => (result.seeds > 1 ? `${result.seed} to ${result.seed + result.seeds - 1}` : String(result.seed));

function failure(root: HTMLElement, { index, result }: Item): void {
  const report = result.failure;
  root.append(
    h("h3", {}, `First difference, configuration ${result.config}, seed ${result.seed}`),
    h("p", {}, report.first),
    h("p", {}, `In the smallest stream that still shows it: ${report.smallest}`, report.operands ? h("br") : null, report.operands ? h("code", {}, report.operands) : null),
    tiles(
      ["Splats", h("span", { class: "figure", "data-figure": path_text(index, ["failure", "splats_before"]) }, number_text(report.splats_before)), " \u2192 ", h("span", { class: "figure", "data-figure": path_text(index, ["failure", "splats_after"]) }, number_text(report.splats_after))],
      ["Runs to shrink it", number_text(report.shrink_runs)],
      report.waveform && ["Waveform", h("small", {}, `${report.waveform}, cycles ${number_text(report.wave_from)} to ${number_text(report.wave_to)}`)],
    ),
    h("p", {}, report.replay ? [h("code", {}, report.replay), " ", command_button(report.replay, "this failure")] : "There is no stream that shows it again."),
  );
  for (const why of report.unwritten ?? []) root.append(note(why));
}

/** Comparisons by seed, over all results; failed seeds have another colour and their names. */
function history(root: HTMLElement, items: Item[]): void {
  const rows = items.flatMap((item) =>
    (item.result.by_seed ?? []).map((row: Result, place: number) => ({ ...row, config: item.result.config, index: item.index, place })),
  );
  if (!rows.length) return;
  const failed = rows.filter((row) => row.verdict !== "pass");
  columns(
    root,
    {
      title: "History by seed",
      about: `comparisons of each seed${failed.length ? "; other colour: it did not pass" : "; all passed"}`,
      label: `${rows.length} seeds, ${failed.length} of them failed`,
      unit: "comparisons",
      x_name: "seed",
    },
    rows.map((row) => ({
      name: `${row.verdict === "pass" ? "" : "\u2717"}${row.seed}`,
      value: row.comparisons,
      colour: row.verdict === "pass" ? "c0" : "c3",
      tip: `${row.config}, seed ${row.seed}: ${row.verdict}, ${number_text(row.comparisons)} comparisons, ${number_text(row.mismatches)} mismatches`,
    })),
  );
  const at = (name: string) => (row: Result) => path_text(row.index, ["by_seed", row.place, name]);
  table(root, {
    label: "Seeds",
    filter: true,
    rows,
    columns: [
      { name: "Configuration", value: (row) => row.config },
      { name: "Seed", value: (row) => row.seed, figure: at("seed") },
      { name: "Verdict", value: (row) => `${row.verdict === "pass" ? "\u2713" : "\u2717"} ${row.verdict}`, kind: (row) => status(row.verdict) },
      { name: "Comparisons", value: (row) => row.comparisons, figure: at("comparisons") },
      { name: "Mismatches", value: (row) => row.mismatches, figure: at("mismatches"), kind: (row) => (row.mismatches > 0 ? "fail" : "") },
      { name: "Streams", value: (row) => row.streams, figure: at("streams") },
      { name: "Splats", value: (row) => row.splats, figure: at("splats") },
      { name: "Cycles", value: (row) => row.cycles, figure: at("cycles") },
    ],
  });
  const left_out = items.reduce((sum, item) => sum + (item.result.by_seed_left_out ?? 0), 0);
  if (left_out) root.append(note(`${number_text(left_out)} more seeds passed and are not listed.`));
}

export const verify: Panel = {
  name: "verify",
  verbs: ["verify"],
  once: true,
  title: "RTL against model",
  about: "The simulated RTL beside its model: all compared values must be equal, bit for bit.",
  render(root, _result, context) {
    const { items } = context;
    const sum = (key: string): number => items.reduce((total, item) => total + (item.result[key] ?? 0), 0);
    const bad = items.filter((item) => item.result.verdict !== "pass");
    const one = items.length === 1 ? items[0] : null;
    const show = (key: string): HTMLElement => (one ? h("span", { class: "figure", "data-figure": path_text(one.index, [key]) }, number_text(one.result[key])) : h("span", { class: "figure", "data-sum": key }, number_text(sum(key))));
    root.append(
      bad.length === 0
        ? lead("pass", "RTL and model agree bit for bit: ", show("mismatches"), " of ", show("comparisons"), " comparisons differ, over ", show("splats"), " splats.")
        : lead("fail", `${bad[0].result.verdict[0].toUpperCase()}${bad[0].result.verdict.slice(1)} in configuration ${bad[0].result.config}, ${number_text(bad.length)} of ${number_text(items.length)} results: `, show("mismatches"), " of ", show("comparisons"), " comparisons differ."),
      tiles(["Streams", show("streams")], ["Windows", show("windows")], ["Cycles of the RTL", show("cycles_rtl")], ["Cycles of the model", show("cycles_model")]),
    );
    for (const item of bad) if (item.result.failure) failure(root, item);
    const parts = grid(root);
    const taps = cell(parts);
    const names = [...new Set(items.flatMap((item) => Object.keys(item.result.by_tap ?? {})))];
    const total = (name: string): number => items.reduce((all, item) => all + (item.result.by_tap?.[name] ?? 0), 0);
    if (names.length)
      stacks(
        taps,
        { title: "Comparisons by tap", label: names.map((name) => `${name} ${total(name)}`).join(", "), unit: "values" },
        names.map((name) => ({ name, shown: number_text(total(name)), parts: [{ name, value: total(name), colour: "c0", tip: `${name}: ${number_text(total(name))} values compared` }] })),
      );
    const covered = items.filter((item) => item.result.coverage);
    if (covered.length)
      stacks(
        cell(parts),
        { title: "Coverage after each result", label: covered.map((item) => `${item.result.config}: ${item.result.coverage.hit} of ${item.result.coverage.bins}`).join(", "), unit: "% of the bins", most: 100 },
        covered.map((item) => ({
          name: `${item.result.config}, seed ${seeds(item.result)}`,
          shown: `${item.result.coverage.hit} / ${item.result.coverage.bins}`,
          parts: [{ name: "hit", value: (100 * item.result.coverage.hit) / Math.max(1, item.result.coverage.bins), colour: "c0", tip: `${item.result.coverage.hit} of ${item.result.coverage.bins} bins hit` }],
        })),
      );
    const figure = (key: string) => (item: Item) => path_text(item.index, [key]);
    root.append(h("h3", {}, "Results"));
    table(root, {
      label: "Results of verify",
      rows: items,
      columns: [
        { name: "Configuration", value: ({ result }) => `${result.config} ${result.config_hash ?? ""}` },
        { name: "Verdict", value: ({ result }) => `${result.verdict === "pass" ? "\u2713" : "\u2717"} ${result.verdict}`, kind: ({ result }) => status(result.verdict) },
        { name: "Seeds", value: ({ result }) => seeds(result) },
        { name: "Comparisons", value: ({ result }) => result.comparisons, figure: figure("comparisons") },
        { name: "Mismatches", value: ({ result }) => result.mismatches, figure: figure("mismatches"), kind: ({ result }) => (result.mismatches > 0 ? "fail" : "") },
        { name: "Splats", value: ({ result }) => result.splats, figure: figure("splats") },
        { name: "Cycles, RTL", value: ({ result }) => result.cycles_rtl, figure: figure("cycles_rtl") },
        { name: "Cycles, model", value: ({ result }) => result.cycles_model, figure: figure("cycles_model") },
        { name: "Ready / input", value: ({ result }) => `${result.ready} / ${result.input}` },
        { name: "Command", value: () => "", cell: ({ result }) => (result.command ? command_button(result.command, "this result") : null) },
      ],
    });
    history(root, items);
  },
};
