// SPDX-License-Identifier: Apache-2.0
// A transfer function that is edited: points in stored values, and the rest of its TOML.
import type { Histogram } from "./answers";

export interface Point {
  at: number;
  colour: [number, number, number];
  opacity: number;
}

const number = (value: number): string => {
  const text = String(value);
  return /[.e]/.test(text) ? text : `${text}.0`;
};

/** The product's TOML. `rest`: lines other than domain and points, kept from the function that was edited. */
export function toml_of(points: Point[], rest = ""): string {
  const lines = points.map(({ at, colour, opacity }) => `  {at = ${number(at)}, colour = [${colour.map(number).join(", ")}], opacity = ${number(opacity)}},`);
  // Top-level keys must stand before the first table.
  const first = rest.search(/^\s*\[/m);
  const [keys, tables] = first < 0 ? [rest, ""] : [rest.slice(0, first), rest.slice(first)];
  return [`domain = "value"`, keys.trim(), "points = [", ...lines, "]", tables.trim(), ""].filter((line, i, all) => line !== "" || i === all.length - 1).join("\n");
}

/** The lines of a TOML that are neither domain nor points, nor comments. */
export function rest_of(toml: string | undefined): string {
  if (!toml) return "";
  return toml
    .replace(/^\s*points\s*=\s*\[[^]*?^\]\s*$/m, "")
    .replace(/^\s*points\s*=.*\]\s*$/m, "")
    .replace(/^\s*\[\[points\]\][^[]*/gm, "")
    .replace(/^\s*(domain|name)\s*=.*$/gm, "")
    .replace(/^\s*#.*$/gm, "")
    .trim();
}

export function points_of(histogram: Histogram): Point[] {
  return histogram.points.map(({ at, colour, opacity }) => ({ at, colour: [...colour], opacity }));
}

const encoded = (v: number): number => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
const decoded = (v: number): number => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);

/** Linear colour as a screen's "#rrggbb", and back. */
export function hex_of(colour: [number, number, number]): string {
  return `#${colour.map((v) => encoded(Math.min(1, Math.max(0, v))).toString(16).padStart(2, "0")).join("")}`;
}
export function colour_of(hex: string): [number, number, number] {
  return [1, 3, 5].map((i) => Number(decoded(parseInt(hex.slice(i, i + 2), 16)).toPrecision(5))) as [number, number, number];
}

/** Colour and opacity between points. */
export function at_value(points: Point[], at: number): Point {
  const after = points.findIndex((point) => point.at >= at);
  if (after <= 0) return { ...(points[after === 0 ? 0 : points.length - 1] ?? { colour: [1, 1, 1], opacity: 0 }), at };
  const [a, b] = [points[after - 1], points[after]];
  const t = (at - a.at) / (b.at - a.at || 1);
  const mix = (x: number, y: number): number => x + (y - x) * t;
  return { at, colour: [0, 1, 2].map((i) => mix(a.colour[i], b.colour[i])) as [number, number, number], opacity: mix(a.opacity, b.opacity) };
}
