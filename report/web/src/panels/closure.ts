// SPDX-License-Identifier: Apache-2.0
// Coverage closure: whether every testpoint of the verification plan is decided, every planned bin hit and every line
// of the RTL reached. Testpoints link to their bins and tests.
import { stacks } from "../bars";
import { h, type Child } from "../dom";
import { figures_of, number_text, path_text, type Path } from "../figures";
import type { Context, Panel, Result } from "../page";
import { cell, grid, lead, note, tiles } from "../parts";
import { legend } from "../svg";
import { table, type Table } from "../table";

interface Bin {
  testpoint: string;
  config: string;
  name: string;
  hits: number;
  path: Path;
}

/** All bins of all testpoints and configurations, those without hits first. */
function bins_of(result: Result): Bin[] {
  const bins: Bin[] = [];
  result.testpoints.forEach((point: Result, i: number) =>
    point.configurations.forEach((on: Result, j: number) => {
      for (const [name, hits] of Object.entries(on.hits as Record<string, number>))
        bins.push({ testpoint: point.name, config: on.config, name, hits, path: ["testpoints", i, "configurations", j, "hits", name] });
    }),
  );
  return [...bins.filter((bin) => bin.hits === 0), ...bins.filter((bin) => bin.hits > 0)];
}

const state = (good: boolean, word: string): string => `${good ? "\u2713" : "\u2717"} ${word}`;
const outcome = (word: string): string => (word === "not run" ? "\u2013 not run here" : state(word === "passed" || word === "closed", word));
const kind_of = (word: string): string => (word === "passed" || word === "closed" ? "pass" : word === "not run" ? "" : "fail");

function findings(root: HTMLElement, open: Record<string, string[]>): void {
  const names: Record<string, string> = { campaigns: "campaign", testpoints: "bin or test", lines: "line" };
  const rows = Object.entries(open).flatMap(([where, texts]) => texts.map((text) => ({ where: names[where] ?? where, text })));
  if (!rows.length) return;
  root.append(h("h3", {}, "What is open"));
  table(root, {
    label: "What is open",
    filter: rows.length > 8,
    rows,
    columns: [
      { name: "Of", value: (row) => row.where },
      { name: "Finding", value: (row) => row.text, kind: () => "fail wrap" },
    ],
  });
}

function shares(root: HTMLElement, result: Result): void {
  const parts = grid(root);
  const percent = (value: number, all: number): number => (100 * value) / Math.max(1, all);
  stacks(
    cell(parts),
    { title: "Bins by configuration", label: result.configurations.map((on: Result) => `${on.config} ${on.bins.hit} of ${on.bins.all}`).join(", "), unit: "% of the bins", most: 100 },
    result.configurations.map((on: Result) => ({
      name: on.config,
      shown: `${on.bins.hit} / ${on.bins.all}`,
      parts: [
        { name: "hit", value: percent(on.bins.hit, on.bins.all), colour: "c0", tip: `${on.config}: ${number_text(on.bins.hit)} of ${number_text(on.bins.all)} bins hit` },
        { name: "open", value: percent(on.bins.all - on.bins.hit, on.bins.all), colour: "c3", tip: `${on.config}: ${number_text(on.bins.all - on.bins.hit)} bins open` },
      ],
    })),
  );
  if (!result.lines.all) return;
  const lines = cell(parts);
  stacks(
    lines,
    { title: "Lines and branches by file", label: result.files.map((file: Result) => `${file.file} ${file.count.reached} of ${file.count.all}, ${file.count.excused} excused`).join(", "), unit: "% of the lines and branches", most: 100, dense: true },
    result.files.filter((file: Result) => file.count.all > 0).map((file: Result) => {
      const { reached, excused, all } = file.count;
      return {
        name: file.file,
        shown: `${reached} / ${all}`,
        parts: [
          { name: "reached", value: percent(reached, all), colour: "c0", tip: `${file.file}: ${reached} of ${all} reached` },
          { name: "excused", value: percent(excused, all), colour: "c1", tip: `${file.file}: ${excused} of ${all} excused` },
          { name: "never reached", value: percent(all - reached - excused, all), colour: "c3", tip: `${file.file}: ${all - reached - excused} of ${all} never reached` },
        ],
      };
    }),
  );
  lines.append(legend([{ name: "hit, reached", colour: "c0" }, { name: "excused", colour: "c1" }, { name: "open", colour: "c3" }]));
}

/** Testpoints; selecting one describes it and lists only its bins and tests. */
function testpoints(root: HTMLElement, result: Result, context: Context): void {
  const points: Result[] = result.testpoints;
  const place = new Map(points.map((point, i) => [point, i]));
  const bins = bins_of(result);
  const weakest = new Map<string, Bin>();
  for (const bin of bins) if (bin.hits < (weakest.get(bin.testpoint)?.hits ?? Infinity)) weakest.set(bin.testpoint, bin);
  const tests = points.flatMap((point) => point.tests.map((test: Result, i: number) => ({ ...test, testpoint: point.name, path: ["testpoints", place.get(point), "tests", i, "runs"] })));
  const path = (...keys: Path): string => path_text(context.index, keys);
  const count = (point: Result, word: string): number => point.tests.filter((test: Result) => test.outcome === word).length;

  let chosen: Result | null = null;
  let listed: Table<Result> | null = null;
  let bin_table: Table<Bin> | null = null;
  let test_table: Table<Result> | null = null;
  const about = h("div", { "aria-live": "polite" });
  const names = (title: string, list: string[]): Child => list.length > 0 && h("p", { class: "note" }, `${title}: `, list.map((name, i) => [i ? ", " : "", h("code", {}, name)]));
  const choose = (point: Result | null): void => {
    chosen = point === chosen ? null : point;
    const name = chosen?.name;
    bin_table?.only(name === undefined ? null : (bin) => bin.testpoint === name);
    test_table?.only(name === undefined ? null : (test) => test.testpoint === name);
    listed?.refresh();
    about.replaceChildren(
      ...(chosen
        ? [h("p", {}, h("strong", {}, chosen.name), `: ${chosen.proves}`), ...[names("Campaigns", chosen.campaigns), names("Assertions", chosen.assertions), names("Faults", chosen.faults)].filter((each) => each instanceof Node)]
        : [note("Bins count where a testpoint's own campaigns hit them. A click on a testpoint, or Enter, lists its bins and tests only.")]),
    );
  };
  root.append(h("h3", {}, "Testpoints"));
  listed = table(root, {
    label: "Testpoints",
    filter: true,
    rows: [...points.filter((point) => point.status === "open"), ...points.filter((point) => point.status !== "open")],
    chosen: (point) => point === chosen,
    choose,
    columns: [
      { name: "Testpoint", value: (point) => point.name },
      { name: "State", value: (point) => outcome(point.status), kind: (point) => kind_of(point.status) },
      { name: "Bins", value: (point) => point.bins.all, figure: (point) => path("testpoints", place.get(point) ?? 0, "bins", "all") },
      { name: "Hit", value: (point) => point.bins.hit, figure: (point) => path("testpoints", place.get(point) ?? 0, "bins", "hit") },
      { name: "Fewest hits", value: (point) => weakest.get(point.name)?.hits, figure: (point) => weakest.has(point.name) ? path(...(weakest.get(point.name) as Bin).path) : undefined },
      { name: "Tests", value: (point) => `${count(point, "passed")} of ${point.tests.length}` },
      { name: "Proves", value: (point) => point.proves, kind: () => "wrap" },
    ],
  });
  root.append(h("div", { class: "controls" }, h("button", { type: "button", click: () => choose(null) }, "All testpoints")), about);
  if (bins.length) {
    root.append(h("h3", {}, "Bins"));
    bin_table = table(root, {
      label: "Bins",
      filter: true,
      rows: bins,
      columns: [
        { name: "Testpoint", value: (bin) => bin.testpoint },
        { name: "Configuration", value: (bin) => bin.config },
        { name: "Bin", value: (bin) => bin.name },
        { name: "Hits", value: (bin) => bin.hits, figure: (bin) => path(...bin.path), kind: (bin) => (bin.hits ? "" : "fail") },
        { name: "State", value: (bin) => state(bin.hits > 0, bin.hits ? "hit" : "never hit"), kind: (bin) => (bin.hits ? "pass" : "fail") },
      ],
    });
  }
  if (tests.length) {
    root.append(h("h3", {}, "Tests"));
    test_table = table(root, {
      label: "Tests",
      filter: true,
      rows: tests,
      columns: [
        { name: "Testpoint", value: (test) => test.testpoint },
        { name: "Test", value: (test) => test.test, cell: (test) => h("code", {}, test.test) },
        { name: "Runs", value: (test) => test.runs, figure: (test) => path(...test.path) },
        { name: "Outcome", value: (test) => outcome(test.outcome), kind: (test) => kind_of(test.outcome) },
      ],
    });
  }
  choose(null);
}

/** A file of the RTL with hit counts and marks beside its lines: \u2713 reached, \u2717 never reached, \u2013
 *  excused. */
function source(file: Result, path: Path, index: number): HTMLElement {
  const lines = file.source.map(() => ({ mark: "", counts: [] as Child[] }));
  const worse = ["", "\u2713", "\u2013", "\u2717"];
  file.points.forEach((point: Result, i: number) => {
    const mark = point.hits > 0 ? "\u2713" : point.excused ? "\u2013" : "\u2717";
    for (const line of [point.line, ...point.lines]) {
      const at = lines[line - 1];
      if (at && worse.indexOf(mark) > worse.indexOf(at.mark)) at.mark = mark;
    }
    const hits = h("span", { class: "figure", "data-figure": path_text(index, [...path, "points", i, "hits"]) }, number_text(point.hits));
    lines[point.line - 1]?.counts.push(h("div", { title: point.excused }, `${point.kind} `, hits));
  });
  const kinds: Record<string, string> = { "\u2713": "pass", "\u2717": "fail" };
  return h(
    "table",
    { class: "source", "aria-label": file.file },
    h("tbody", {}, file.source.map((text: string, i: number) => h("tr", {}, h("td", { class: "num" }, i + 1), h("td", { class: kinds[lines[i].mark] }, lines[i].mark), h("td", { class: "num" }, lines[i].counts), h("td", {}, text)))),
  );
}

function lines(root: HTMLElement, result: Result, context: Context): void {
  const files: Result[] = result.files;
  const place = new Map(files.map((file, i) => [file, i]));
  const open = (file: Result): number => file.count.all - file.count.reached - file.count.excused;
  const at = (key: string) => (file: Result): string => path_text(context.index, ["files", place.get(file) ?? 0, "count", key]);
  let chosen: Result | null = null;
  const shown = h("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": "Source" });
  const box = h("div", { class: "table long" }, shown);
  root.append(
    h("h3", {}, "Lines and branches of the RTL"),
    note("Counted over all instances and runs of the configurations with line counts. A click on a file, or Enter, shows its source: \u2713 reached, \u2717 never reached, \u2013 excused."),
  );
  const listed = table(root, {
    label: "Files of the RTL",
    rows: [...files].sort((a, b) => open(b) - open(a)),
    chosen: (file) => file === chosen,
    choose: (file) => choose(file),
    columns: [
      { name: "File", value: (file) => file.file },
      { name: "Lines and branches", value: (file) => file.count.all, figure: at("all") },
      { name: "Reached", value: (file) => file.count.reached, figure: at("reached") },
      { name: "Excused", value: (file) => file.count.excused, figure: at("excused") },
      { name: "Never reached", value: open, kind: (file) => (open(file) ? "fail" : "") },
    ],
  });
  const choose = (file: Result): void => {
    chosen = file === chosen ? null : file;
    box.hidden = chosen === null;
    shown.replaceChildren(...(chosen ? [source(chosen, ["files", place.get(chosen) ?? 0], context.index)] : []));
    listed.refresh();
    const first = [...shown.querySelectorAll("tr")].find((row) => row.querySelector(".fail"));
    shown.scrollTop = first ? Math.max(0, first.offsetTop - 60) : 0;
  };
  root.append(box);
  box.hidden = true;
  const worst = files.find((file) => open(file) > 0);
  if (worst) choose(worst);

  const excused = files.flatMap((file) => file.points.filter((point: Result) => point.excused).map((point: Result) => ({ ...point, file })));
  if (!excused.length) return;
  root.append(h("h3", {}, "Excused"));
  table(root, {
    label: "Excused",
    filter: excused.length > 8,
    rows: excused,
    columns: [
      { name: "Place", value: (point) => `${point.file.file}:${point.line}` },
      { name: "Kind", value: (point) => point.kind },
      { name: "Line", value: (point) => String(point.file.source[point.line - 1] ?? "").trim(), cell: (point) => h("code", {}, String(point.file.source[point.line - 1] ?? "").trim()), kind: () => "wrap" },
      { name: "Because", value: (point) => point.excused, kind: () => "wrap" },
    ],
  });
}

export const closure: Panel = {
  name: "closure",
  verbs: ["closure"],
  title: "Coverage closure",
  about: "Whether the verification plan is fulfilled: bins hit, tests passed, lines of the RTL reached.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const closed = result.verdict === "closed";
    const open = Object.values(result.open as Record<string, string[]>).reduce((sum, list) => sum + list.length, 0);
    const { tests } = result;
    root.append(
      lead(closed ? "pass" : "fail", closed ? "Closed: " : `Open in ${number_text(open)} places: `, show(["bins", "hit"]), " of ", show(["bins", "all"]), " bins are hit", result.lines.all > 0 && [", ", show(["lines", "reached"]), " of ", show(["lines", "all"]), " lines and branches reached, ", show(["lines", "excused"]), " excused"], "."),
      note("The RTL beside its model: what was counted had been compared, bit for bit. Bins by testpoint and configuration."),
      tiles(
        tests.passed + tests.failed > 0 && ["Tests passed", show(["tests", "passed"]), ` / ${number_text(tests.passed + tests.failed)}`],
        tests.not_run > 0 && ["Tests not run here", show(["tests", "not_run"])],
        ["Streams", show(["streams"])],
        ["Splats", show(["splats"])],
        ["Comparisons", show(["comparisons"])],
        ["Cycles", show(["cycles"])],
      ),
    );
    findings(root, result.open);
    shares(root, result);
    root.append(h("h3", {}, "Configurations"));
    const at = (...keys: string[]) => (on: Result): string => path_text(context.index, ["configurations", result.configurations.indexOf(on), ...keys]);
    table(root, {
      label: "Configurations",
      rows: result.configurations as Result[],
      columns: [
        { name: "Configuration", value: (on) => on.config },
        { name: "Hash", value: (on) => on.config_hash, cell: (on) => h("code", {}, on.config_hash) },
        { name: "Bins", value: (on) => on.bins.all, figure: at("bins", "all") },
        { name: "Hit", value: (on) => on.bins.hit, figure: at("bins", "hit"), kind: (on) => (on.bins.hit < on.bins.all ? "fail" : "") },
        ...["streams", "splats", "cycles", "comparisons"].map((key) => ({ name: key[0].toUpperCase() + key.slice(1), value: (on: Result) => on[key], figure: at(key) })),
      ],
    });
    testpoints(root, result, context);
    if (result.lines.all > 0) lines(root, result, context);
  },
};
