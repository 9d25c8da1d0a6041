// SPDX-License-Identifier: Apache-2.0
// Bar charts: waterfalls that add up, stacked shares, columns.
import { axis_below, axis_left, drawing, line, rectangle, text, text_width, type Drawing } from "./svg";
import { linear, logarithmic } from "./scales";

export interface Fall {
  name: string;
  /** What it adds; for a total, the sum of all rows before it. */
  value: number;
  /** Shown at the end of its row. */
  shown: string;
  tip: string;
  total?: boolean;
  colour?: string;
}

const row = 24;

/** A horizontal waterfall: each row begins where the one before ended; totals begin at 0. `from` shortens the axis:
 *  the first total is cut there, and marked, if it would reduce the following parts to hairlines. */
export function waterfall(
  root: HTMLElement,
  options: { title: string; about?: string; label: string; unit: string; from?: number },
  falls: Fall[],
): void {
  drawing(root, options, (to) => {
    const names = Math.min(Math.max(...falls.map((fall) => text_width(fall.name))) + 10, to.width * 0.36);
    const values = Math.max(...falls.map((fall) => text_width(fall.shown))) + 10;
    const spans: [number, number][] = [];
    let sum = 0;
    for (const fall of falls) {
      const start = fall.total ? 0 : sum;
      sum = fall.total ? fall.value : sum + fall.value;
      spans.push([start, sum]);
    }
    const low = options.from ?? Math.min(0, ...spans.flat());
    const high = Math.max(...spans.flat());
    const right = to.width - values;
    const scale = linear(low, high, names, right, right - names > 300 ? 6 : 3);
    const bottom = falls.length * row + 4;
    to.height(bottom + 36);
    axis_below(to, scale, 0, bottom, options.unit);
    falls.forEach((fall, i) => {
      const y = i * row + 2;
      const [a, b] = spans[i].map((value) => scale(Math.max(value, low)));
      const colour = fall.colour ?? (fall.total ? "c7" : fall.value < 0 ? "c2" : "c3");
      const bar = rectangle(Math.min(a, b), y + 3, Math.max(Math.abs(b - a), fall.value === 0 ? 0 : 1), row - 8, colour);
      const whole = text(names - 8, y + row / 2 + 4, shortened(fall.name, names), { "text-anchor": "end" });
      to.svg.append(bar, whole, text(to.width, y + row / 2 + 4, fall.shown, { "text-anchor": "end", class: "tick" }));
      if (options.from !== undefined && spans[i][0] < low && fall.total)
        to.svg.append(cut_mark(names + 10, y + 1, row - 4));
      if (i + 1 < falls.length) to.svg.append(line(b, y + row - 5, b, y + row + 3, { class: "axis" }));
      to.tip(bar, fall.tip, true);
    });
    to.svg.append(line(scale(Math.max(0, low)), 0, scale(Math.max(0, low)), bottom, { class: "axis" }));
  });
}

/** A slanted gap that marks a bar as cut. */
function cut_mark(x: number, y: number, height: number): SVGElement {
  return line(x + 4, y, x - 4, y + height, { stroke: "var(--paper)", "stroke-width": 4 });
}

function shortened(name: string, width: number): string {
  const most = Math.floor((width - 8) / 6.6);
  return name.length <= most ? name : `${name.slice(0, Math.max(3, most - 1))}\u2026`;
}

export interface Stack {
  name: string;
  parts: { name: string; value: number; colour: string; tip: string }[];
  shown: string;
}

/** One bar per row, its parts side by side; all on one axis from 0. */
export function stacks(root: HTMLElement, options: { title: string; about?: string; label: string; unit: string; most?: number; format?: (value: number) => string; dense?: boolean }, rows: Stack[]): void {
  drawing(root, options, (to) => {
    const names = Math.min(Math.max(...rows.map((each) => text_width(each.name))) + 10, to.width * 0.36);
    const values = Math.max(...rows.map((each) => text_width(each.shown))) + 10;
    const most = options.most ?? Math.max(...rows.map((each) => each.parts.reduce((sum, part) => sum + part.value, 0)), 1e-12);
    const scale = linear(0, most, names, to.width - values, to.width > 600 ? 6 : 3);
    const each_row = options.dense ? 18 : row + 4;
    const bottom = rows.length * each_row + 2;
    to.height(bottom + 36);
    axis_below(to, scale, 0, bottom, options.unit, options.format);
    rows.forEach((each, i) => {
      const y = i * each_row + 2;
      const base = y + each_row / 2 + 2;
      to.svg.append(
        text(names - 8, base, shortened(each.name, names), { "text-anchor": "end" }),
        text(to.width, base, each.shown, { "text-anchor": "end", class: "tick" }),
      );
      let sum = 0;
      for (const part of each.parts) {
        const [from, end] = [scale(sum), scale((sum += part.value))];
        if (part.value <= 0) continue;
        const bar = rectangle(from, y + 1, end - from, each_row - (options.dense ? 4 : 8), part.colour, { stroke: "var(--paper)", "stroke-width": 1 });
        to.svg.append(bar);
        to.tip(bar, part.tip, end - from > 3);
      }
    });
  });
}

export interface Column {
  name: string;
  value: number;
  tip: string;
  colour?: string;
}

/** Columns side by side; a count of 1 is still visible on a logarithmic axis. */
export function columns(
  root: HTMLElement,
  options: { title: string; about?: string; label: string; unit: string; logs?: boolean; height?: number; x_name?: string },
  all: Column[],
): void {
  drawing(root, options, (to) => {
    const left = 46;
    const height = options.height ?? 190;
    const bottom = height - 40;
    to.height(height);
    const most = Math.max(1, ...all.map((column) => column.value));
    const scale = options.logs ? logarithmic(0.7, most * 1.2, bottom, 8, 5) : linear(0, most, bottom, 8, 4);
    axis_left(to, scale, left, to.width);
    const step = (to.width - left) / Math.max(1, all.length);
    label_columns(to, all, left, step, bottom);
    all.forEach((column, i) => {
      const x = left + i * step;
      const gap = Math.min(3, step * 0.15);
      const y = column.value > 0 ? Math.min(scale(column.value), bottom - 1) : bottom;
      const bar = rectangle(x + gap, y, Math.min(step - 2 * gap, 90), bottom - y, column.colour ?? "c0");
      to.svg.append(bar);
      if (column.value > 0) to.tip(bar, column.tip, all.length <= 64);
    });
    to.svg.append(line(left, bottom, to.width, bottom, { class: "axis" }));
    if (options.x_name) to.svg.append(text(to.width, bottom + 32, options.x_name, { class: "tick", "text-anchor": "end" }));
    to.svg.append(text(left, bottom + 32, options.unit, { class: "tick" }));
  });
}

function label_columns(to: Drawing, all: Column[], left: number, step: number, bottom: number): void {
  let free = -Infinity;
  all.forEach((column, i) => {
    const width = text_width(column.name, 11);
    const centre = left + i * step + Math.min(step, 96) / 2;
    if (centre - width / 2 < free || centre + width / 2 > to.width + 6) return;
    free = centre + width / 2 + 8;
    to.svg.append(text(centre, bottom + 15, column.name, { class: "tick", "text-anchor": "middle" }));
  });
}
