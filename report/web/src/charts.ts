// SPDX-License-Identifier: Apache-2.0
// Plots with two axes, drawn by uPlot: lines over a shared x, and scatter plots with a brush. uPlot draws on a canvas,
// so plots are recreated when colours or width change.
import uPlot from "uplot";
import { h } from "./dom";
import { number_text, tick_text } from "./figures";
import { nice_step } from "./scales";
import { colour, on_theme } from "./theme";

export interface Axis {
  name: string;
  log?: boolean;
  /** Fixed ticks, for axes with few values. */
  ticks?: number[];
}

export interface Line {
  name: string;
  colour: string;
  /** In any order; a line need not have every x of the others. */
  points: [x: number, y: number | null][];
  dash?: number[];
  /** Points without a line. */
  dots?: boolean;
  size?: number;
  /** Diamonds instead of dots, so that important points differ not only in colour. */
  diamond?: boolean;
}

export interface Span {
  x: [number, number];
  y: [number, number];
}

export interface PlotOptions {
  label: string;
  x: Axis;
  y: Axis;
  height?: number;
  /** Called with the brushed rectangle in the axes' values, or null when it is cleared. */
  brushed?: (span: Span | null) => void;
  /** Called when the pointer moves onto a point, or with null when it leaves. */
  hovered?: (point: { line: number; at: number } | null) => void;
  picked?: (point: { line: number; at: number }) => void;
}

/** Ticks of an axis: 1, 2 and 5 times powers of ten on a logarithmic axis, fewer on long ones. */
function ticks(axis: Axis, low: number, high: number, count: number): number[] {
  if (axis.ticks) return axis.ticks.filter((value) => value >= low && value <= high);
  if (!axis.log) {
    const step = nice_step(high - low, count);
    const all: number[] = [];
    for (let i = Math.ceil(low / step); i * step <= high; ++i) all.push(Number((i * step).toPrecision(12)));
    return all;
  }
  const decades = Math.log10(high / low);
  const parts = decades < 1.6 ? [1, 2, 3, 5] : decades < 3 ? [1, 3] : [1];
  const all: number[] = [];
  const every = Math.max(1, Math.ceil(decades / count));
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1)
    for (const part of parts) if (power % every === 0 && part * 10 ** power >= low && part * 10 ** power <= high) all.push(Number((part * 10 ** power).toPrecision(12)));
  return all;
}

function padded(axis: Axis, low: number, high: number): [number, number] {
  if (!Number.isFinite(low) || !Number.isFinite(high)) return axis.log ? [1, 10] : [0, 1];
  if (axis.log) {
    const room = Math.max(1.12, (high / low) ** 0.05);
    return [low / room, high * room];
  }
  const room = (high - low) * 0.05 || Math.abs(high) * 0.1 || 1;
  return [low >= 0 && low - room < 0 ? (low === 0 ? -room : 0) : low - room, high + room];
}

function diamond(plot: uPlot, series: number, first: number, last: number): void {
  const { ctx } = plot;
  const ratio = devicePixelRatio || 1;
  const size = 6 * ratio;
  ctx.save();
  ctx.fillStyle = String(plot.series[series].points?.fill instanceof Function ? plot.series[series].points.fill(plot, series) : plot.series[series].stroke instanceof Function ? (plot.series[series].stroke as () => string)() : "");
  ctx.strokeStyle = colour("ink");
  ctx.lineWidth = ratio;
  for (let i = first; i <= last; ++i) {
    const y = plot.data[series][i];
    if (y === null || y === undefined) continue;
    const [px, py] = [plot.valToPos(plot.data[0][i], "x", true), plot.valToPos(y, "y", true)];
    ctx.beginPath();
    ctx.moveTo(px, py - size);
    ctx.lineTo(px + size, py);
    ctx.lineTo(px, py + size);
    ctx.lineTo(px - size, py);
    ctx.closePath();
    ctx.fill();
    ctx.stroke();
  }
  ctx.restore();
}

/** Maps the points of all lines to one shared, sorted x. */
interface Joined {
  data: uPlot.AlignedData;
  /** Index of the point of line i at position j of the data; -1 for none. */
  points: number[][];
}

function joined(lines: Line[]): Joined {
  // Points of one line may share an x, so each point gets its own position, unless x is unique in every line.
  const unique = lines.every((each) => new Set(each.points.map(([x]) => x)).size === each.points.length);
  const xs: number[] = [];
  const places: { x: number; line: number; at: number }[] = lines.flatMap((each, line) => each.points.map(([x], at) => ({ x, line, at })));
  places.sort((a, b) => a.x - b.x);
  const data: (number | null)[][] = lines.map(() => []);
  const points: number[][] = lines.map(() => []);
  for (const { x, line, at } of places) {
    if (!unique || !xs.length || xs[xs.length - 1] !== x) {
      xs.push(x);
      data.forEach((each) => each.push(null));
      points.forEach((each) => each.push(-1));
    }
    data[line][xs.length - 1] = lines[line].points[at][1];
    points[line][xs.length - 1] = at;
  }
  return { data: [xs, ...data] as uPlot.AlignedData, points };
}

export interface Plot {
  root: HTMLElement;
  update(lines: Line[], options?: Partial<PlotOptions>): void;
  clear_brush(): void;
}

/** A plot in `root`; update() redraws it with other lines. */
export function plot(root: HTMLElement, options: PlotOptions, lines: Line[]): Plot {
  const place = h("div", { class: "chart plot", role: "img", "aria-label": options.label });
  root.append(place);
  let drawn: uPlot | null = null;
  let width = 0;
  let settings = options;
  let brushing = false;

  const draw = (): void => {
    width = Math.floor(place.clientWidth);
    if (width <= 0) return;
    drawn?.destroy();
    place.setAttribute("aria-label", settings.label);
    const { data, points } = joined(lines);
    const axis = (of: Axis, side: 0 | 1): uPlot.Axis => ({
      stroke: colour("soft"),
      grid: { stroke: colour("grid"), width: 1 },
      ticks: { stroke: colour("edge"), width: 1, size: 4 },
      font: '11px system-ui, "DejaVu Sans", sans-serif',
      labelFont: '12px system-ui, "DejaVu Sans", sans-serif',
      label: of.name,
      labelSize: 18,
      size: side === 0 ? 30 : 52,
      gap: 4,
      splits: (_self, _axis, low, high) => ticks(of, low, high, side === 0 ? Math.max(2, width / 110) : 6),
      values: (_self, splits) => splits.map((value) => (value === null ? "" : tick_text(value))),
      filter: (_self, splits) => splits,
    });
    const scale = (of: Axis): uPlot.Scale => ({
      time: false,
      distr: of.log ? 3 : 1,
      range: (_self, low, high) => padded(of, low, high),
    });
    const nearest = (self: uPlot): { line: number; at: number } | null => {
      const { left, top } = self.cursor;
      if (left === undefined || top === undefined || left < 0) return null;
      let best: { line: number; at: number } | null = null;
      let least = 14 * 14;
      lines.forEach((_line, l) => {
        for (let i = 0; i < data[0].length; ++i) {
          const y = data[l + 1][i];
          if (y === null || y === undefined) continue;
          const distance = (self.valToPos(data[0][i], "x") - left) ** 2 + (self.valToPos(y, "y") - top) ** 2;
          if (distance > least) continue;
          least = distance;
          best = { line: l, at: points[l][i] };
        }
      });
      return best;
    };
    drawn = new uPlot(
      {
        width,
        height: settings.height ?? 280,
        scales: { x: scale(settings.x), y: scale(settings.y) },
        axes: [axis(settings.x, 0), axis(settings.y, 1)],
        legend: { show: false },
        padding: [8, 14, 0, 0],
        cursor: {
          points: { show: false },
          x: false,
          y: false,
          drag: settings.brushed ? { x: true, y: true, setScale: false, uni: 8 } : { x: false, y: false, setScale: false },
        },
        series: [
          {},
          ...lines.map((each): uPlot.Series => {
            const stroke = (): string => colour(each.colour);
            return {
              label: each.name,
              stroke,
              width: each.dots ? 0 : 2,
              dash: each.dash,
              spanGaps: true,
              ...(each.dots ? { paths: () => null } : {}),
              points: {
                show: each.diamond ? (self, s, first, last) => (diamond(self, s, first, last), false) : true,
                size: each.size ?? 6,
                fill: stroke,
                stroke,
                width: 0,
              },
            };
          }),
        ],
        hooks: {
          setSelect: [
            (self) => {
              const { left, top, width: w, height: hh } = self.select;
              brushing = w > 2 && hh > 2;
              if (!brushing) return;
              settings.brushed?.({
                x: [self.posToVal(left, "x"), self.posToVal(left + w, "x")],
                y: [self.posToVal(top + hh, "y"), self.posToVal(top, "y")],
              });
            },
          ],
          setCursor: [(self) => settings.hovered?.(nearest(self))],
          ready: [
            (self) => {
              self.over.addEventListener("click", () => {
                const point = nearest(self);
                if (point && !brushing) settings.picked?.(point);
                else if (!point && brushing === false) settings.brushed?.(null);
                brushing = false;
              });
            },
          ],
        },
      },
      data,
      place,
    );
  };
  draw();
  new ResizeObserver(() => {
    if (Math.floor(place.clientWidth) !== width) draw();
  }).observe(place);
  on_theme(draw);
  return {
    root: place,
    update: (next, more) => {
      lines = next;
      settings = { ...settings, ...more };
      const select = drawn?.select;
      const kept = select && select.width > 0 ? { ...select } : null;
      draw();
      if (kept && settings.brushed) drawn?.setSelect(kept, false);
    },
    clear_brush: () => drawn?.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false),
  };
}

/** Legend of a plot: colour, shape and name of each line. */
export function line_legend(lines: Line[]): HTMLElement {
  return h(
    "ul",
    { class: "legend" },
    lines.map((each) => h("li", {}, h("span", { class: each.diamond ? "key diamond" : each.dash ? "key dashed" : "key", style: `--key:var(--${each.colour})` }), each.name)),
  );
}

export function at_text(name: string, axis: Axis, x: number, other: Axis, y: number): string {
  return `${name}: ${axis.name} ${number_text(x)}, ${other.name} ${number_text(y)}`;
}
