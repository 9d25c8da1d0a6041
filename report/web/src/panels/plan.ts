// SPDX-License-Identifier: Apache-2.0
// A merged plan: any two metrics against each other, the Pareto front, all rows; plot and table are linked.
import { line_legend, plot, type Line, type Plot, type Span } from "../charts";
import { command_button, h } from "../dom";
import { figures_of, number_text, path_text } from "../figures";
import type { Panel, Result } from "../page";
import { lead, note, tiles } from "../parts";
import { series_colours } from "../theme";
import { table, type Column, type Table } from "../table";
import { books_of, draw_books } from "./coverage";

interface Quantity {
  id: string;
  title: string;
  unit: string;
  better: "less" | "more" | null;
  axis: boolean;
  of: (row: Result) => number | string | null | undefined;
}

/** The Pareto front of the passed rows, sorted by x: rows that no other dominates (better in one, no worse in the
 *  other); of equal rows all are on it. Same definition as in `plan pareto`. */
export function pareto(rows: Result[], x: Quantity, y: Quantity): Result[] {
  const sign = (quantity: Quantity): number => (quantity.better === "more" ? -1 : 1);
  const points = rows
    .filter((row) => row.status === "pass" && typeof x.of(row) === "number" && typeof y.of(row) === "number")
    .map((row) => ({ row, x: sign(x) * Number(x.of(row)), y: sign(y) * Number(y.of(row)) }))
    .sort((a, b) => a.x - b.x || a.y - b.y);
  const front: typeof points = [];
  for (const point of points) {
    const last = front[front.length - 1];
    if (!last || point.y < last.y || (point.x === last.x && point.y === last.y)) front.push(point);
  }
  return front.map((point) => point.row).sort((a, b) => Number(x.of(a)) - Number(x.of(b)));
}

/** Whether to use a logarithmic axis: values are positive and span more than two decades. */
function is_wide(values: number[]): boolean {
  const low = Math.min(...values);
  return low > 0 && Math.max(...values) / low > 100;
}

export const plan: Panel = {
  name: "plan",
  verbs: ["plan"],
  title: (result) => `Plan: ${result.title || result.name || ""}`,
  about: "A parameter sweep: every point and every row is one case.",
  render(root, result, context) {
    const rows: Result[] = result.rows ?? [];
    const index = new Map(rows.map((row, i) => [row, i]));
    const show = figures_of(context.index, result);
    const count = (status: string): number => rows.filter((row) => row.status === status).length;
    const [failed, broken] = [count("fail"), count("error")];
    root.append(
      lead(
        broken ? "error" : failed ? "fail" : rows.length ? "pass" : "none",
        rows.length === 0
          ? "The plan has no case."
          : failed + broken === 0
            ? `All ${number_text(rows.length)} cases passed.`
            : `${number_text(failed + broken)} of ${number_text(rows.length)} cases did not pass${broken ? `, ${number_text(broken)} of them could not be run` : ""}.`,
      ),
      note("Plan ", h("code", {}, String(result.hash ?? "")), result.program ? [", program ", h("code", {}, String(result.program))] : null),
      tiles(["Cases", number_text(rows.length)], ["Passed", number_text(count("pass"))], ["Failed", number_text(failed)], ["Broken", number_text(broken)], ["Version", show(["version"])]),
    );
    const missing: string[] = result.missing ?? [];
    if (missing.length) root.append(note(`${number_text(missing.length)} cases have no result yet: ${missing.slice(0, 5).join(", ")}${missing.length > 5 ? ", \u2026" : ""}`));
    if (!rows.length) return;

    const axes: Quantity[] = (result.axes ?? []).map((axis: Result) => ({ id: `axis ${axis.name}`, title: axis.title ?? axis.name, unit: "", better: null, axis: true, of: (row: Result) => row.axes?.[axis.name] }));
    const metrics: Quantity[] = (result.metrics ?? []).map((metric: Result) => ({
      id: metric.name,
      title: metric.title ?? metric.name,
      unit: metric.unit ?? "",
      better: metric.better ?? null,
      axis: false,
      of: (row: Result) => row.metrics?.[metric.name],
    }));
    const numeric = (quantity: Quantity): boolean => rows.some((row) => typeof quantity.of(row) === "number");
    const plottable = [...metrics, ...axes].filter(numeric);
    const judged = metrics.filter((metric) => metric.better !== null && numeric(metric));

    const chosen = new Set<Result>();
    let span: Span | null = null;
    let drawn: Plot | null = null;
    let listed: Table<Result> | null = null;
    let shown: Result[] = rows;
    let lines_rows: Result[][] = [];

    const option = (quantity: Quantity): HTMLElement => h("option", { value: quantity.id }, quantity.unit ? `${quantity.title}, ${quantity.unit}` : quantity.title);
    const draw_again = (): void => {
      span = null;
      drawn?.clear_brush();
      listed?.only(null);
      draw();
    };
    const pick_x = h("select", { change: draw_again }, plottable.map(option));
    const pick_y = h("select", { change: draw_again }, plottable.map(option));
    const pick_colour = h("select", { change: () => draw() }, h("option", { value: "" }, "status"), axes.map(option));
    const clear = h(
      "button",
      {
        type: "button",
        click: () => {
          span = null;
          chosen.clear();
          drawn?.clear_brush();
          listed?.only(null);
          draw();
        },
      },
      "All rows",
    );
    const caption = h("p", { class: "note", "aria-live": "polite" });
    const place = h("div");
    const key = h("div");
    if (plottable.length >= 2) {
      // Cost on x, benefit on y.
      const costs = (quantity: Quantity): boolean => quantity.better === "less" && /cost|bits|area|cycles|seconds/i.test(quantity.id);
      pick_x.value = (judged.find(costs) ?? judged.find((metric) => metric.better === "less") ?? plottable[0]).id;
      const others = judged.filter((metric) => metric.id !== pick_x.value);
      pick_y.value = (others.find((metric) => !costs(metric)) ?? others[0] ?? plottable.find((each) => each.id !== pick_x.value) ?? plottable[1]).id;
      root.append(
        h("div", { class: "controls" }, h("label", {}, "Across ", pick_x), h("label", {}, "Up ", pick_y), h("label", {}, "Colour ", pick_colour), clear),
        place,
        key,
        caption,
      );
    }

    function draw(): void {
      if (plottable.length < 2) return;
      const x = plottable.find((each) => each.id === pick_x.value) as Quantity;
      const y = plottable.find((each) => each.id === pick_y.value) as Quantity;
      const usable = shown.filter((row) => typeof x.of(row) === "number" && typeof y.of(row) === "number" && row.status !== "error");
      const front = x === y ? [] : pareto(usable, x, y);
      const by = axes.find((axis) => axis.id === pick_colour.value);
      const values = by ? [...new Set(rows.map((row) => String(by.of(row))))] : ["pass", "fail"];
      values.sort((a, b) => a.localeCompare(b, "en", { numeric: true }));
      const groups: [string, string, Result[]][] = by
        ? values.slice(0, 8).map((value, i) => [i === 7 && values.length > 8 ? "others" : `${by.title} ${value}`, series_colours[i], usable.filter((row) => (i === 7 && values.length > 8 ? values.indexOf(String(by.of(row))) >= 7 : String(by.of(row)) === value))])
        : [
            ["passed", "c0", usable.filter((row) => row.status === "pass")],
            ["failed", "c3", usable.filter((row) => row.status !== "pass")],
          ];
      const point = (row: Result): [number, number] => [Number(x.of(row)), Number(y.of(row))];
      const lines: Line[] = [
        ...groups.filter(([, , mine]) => mine.length).map(([name, colour, mine]): Line => ({ name, colour, dots: true, size: 6, points: mine.map(point) })),
        { name: "Pareto front", colour: "c1", diamond: true, dash: [5, 3], points: front.map(point) },
        { name: "chosen", colour: "c4", dots: true, size: 14, points: usable.filter((row) => chosen.has(row)).map(point) },
      ];
      lines_rows = [...groups.filter(([, , mine]) => mine.length).map(([, , mine]) => mine), front, usable.filter((row) => chosen.has(row))];
      const title = (quantity: Quantity): string => `${quantity.title}${quantity.unit ? `, ${quantity.unit}` : ""}${quantity.better ? ` (${quantity.better} is better)` : ""}`;
      const numbers = (quantity: Quantity): number[] => usable.map((row) => Number(quantity.of(row)));
      const settings = {
        label: `${title(y)} over ${title(x)}: ${usable.length} cases, ${front.length} on the Pareto front`,
        x: { name: title(x), log: usable.length > 0 && is_wide(numbers(x)) },
        y: { name: title(y), log: usable.length > 0 && is_wide(numbers(y)) },
        height: 380,
        brushed: (to: Span | null) => {
          span = to;
          listed?.only(to === null ? null : (row) => inside(row, x, y, to));
        },
        hovered: (at: { line: number; at: number } | null) => describe(at ? lines_rows[at.line][at.at] : null, x, y),
        picked: (at: { line: number; at: number }) => choose(lines_rows[at.line][at.at], true),
      };
      if (drawn) drawn.update(lines, settings);
      else drawn = plot(place, settings, lines);
      key.replaceChildren(line_legend(lines.filter((line) => line.name !== "chosen" || line.points.length)));
      key.dataset.front = front.map((row) => row.id).join(" ");
      describe(null, x, y);
    }

    function inside(row: Result, x: Quantity, y: Quantity, to: Span): boolean {
      const [a, b] = [Number(x.of(row)), Number(y.of(row))];
      return typeof x.of(row) === "number" && typeof y.of(row) === "number" && a >= to.x[0] && a <= to.x[1] && b >= to.y[0] && b <= to.y[1];
    }

    function describe(row: Result | null, x: Quantity, y: Quantity): void {
      caption.textContent = row
        ? `${Object.entries(row.axes ?? {}).map(([name, value]) => `${name} ${value}`).join(", ")}: ${x.title} ${number_text(x.of(row))}, ${y.title} ${number_text(y.of(row))}, ${row.status}`
        : span
          ? `${number_text(shown.length)} cases in the rectangle; a click beside the points takes it back.`
          : "Draw a rectangle to list only its cases; click a point or a row to mark it in both.";
    }

    function choose(row: Result, from_plot = false): void {
      if (chosen.has(row)) chosen.delete(row);
      else chosen.add(row);
      draw();
      listed?.refresh();
      if (from_plot) listed?.reveal(row);
    }

    const columns: Column<Result>[] = [
      { name: "Status", value: (row) => `${row.status === "pass" ? "\u2713" : "\u2717"} ${row.status}`, kind: (row) => (row.status === "pass" ? "pass" : "fail") },
      ...axes.map((axis, i): Column<Result> => ({
        name: result.axes[i].title ?? result.axes[i].name,
        value: (row) => axis.of(row),
        figure: (row) => path_text(context.index, ["rows", index.get(row) ?? 0, "axes", result.axes[i].name]),
      })),
      ...metrics.map((metric): Column<Result> => ({
        name: metric.title,
        unit: metric.unit,
        value: (row) => metric.of(row),
        figure: (row) => path_text(context.index, ["rows", index.get(row) ?? 0, "metrics", metric.id]),
      })),
      ...(rows.some((row) => row.message) ? [{ name: "Message", value: (row: Result) => row.message } as Column<Result>] : []),
      { name: "Case", value: (row) => row.id, cell: (row) => h("code", {}, String(row.id ?? "").slice(0, 12)) },
      { name: "Command", value: () => "", cell: (row) => (row.command ? command_button(row.command, "this case") : null) },
    ];
    const body = h("div");
    root.append(body);
    listed = table(body, {
      label: "Cases",
      filter: true,
      rows,
      columns,
      chosen: (row) => chosen.has(row),
      choose: (row) => choose(row),
      changed: (left) => {
        shown = left;
        // The filter changes the front; the brush alone keeps the points.
        if (span) {
          shown = left;
          caption.textContent = `${number_text(left.length)} cases in the rectangle; a click beside the points takes it back.`;
        } else draw();
      },
    });
    const books = books_of(result.coverage, ["coverage"]);
    if (books.length) {
      root.append(h("h3", {}, "Coverage of the plan"));
      draw_books(root, books, context);
    }
  },
};
