// SPDX-License-Identifier: Apache-2.0
// Formats numbers, and creates elements that show them with their path in the JSON.
import { h } from "./dom";
import type { Result } from "./page";

const thin = "\u202f"; // narrow no-break space between thousands
const minus = "\u2212";

/** Path into JSON; a key that contains a dot is one step. */
export type Path = (string | number)[];

export function at(result: Result, path: Path): Result {
  return path.reduce((value: Result, key) => (value === null || value === undefined ? undefined : value[key]), result);
}

/** "0.cycles.actual"; dots within keys become %2e. */
export function path_text(index: number, path: Path): string {
  return [index, ...path].map((key) => String(key).replaceAll("%", "%25").replaceAll(".", "%2e")).join(".");
}

export interface Style {
  /** Digits after the point; default: integers in full, others with 4 significant digits. */
  digits?: number;
  /** Shown number = JSON's number x scale: 100 for percent. */
  scale?: number;
  unit?: string;
  /** Shows a plus sign on positive numbers. */
  sign?: boolean;
}

function grouped(digits: string): string {
  return digits.replace(/\B(?=(\d{3})+(?!\d))/g, thin);
}

/** Formats a number: 12 345, 0.4119, 3.2e-9, -0.021; an en dash if it is missing. */
export function number_text(value: unknown, style: Style = {}): string {
  if (typeof value !== "number" || Number.isNaN(value)) return "\u2013";
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : `${minus}\u221e`;
  const scaled = value * (style.scale ?? 1);
  const size = Math.abs(scaled);
  let text: string;
  if (style.digits !== undefined) text = size.toFixed(style.digits);
  else if (Number.isInteger(scaled) && size < 1e15) text = String(size);
  else if (size !== 0 && (size < 1e-4 || size >= 1e12)) text = size.toExponential(2);
  else text = size.toFixed(Math.max(0, Math.min(7, 3 - Math.floor(Math.log10(size)))));
  const [whole, rest] = text.split(".");
  const shown = /e/.test(text) ? text : grouped(whole) + (rest === undefined ? "" : `.${rest}`);
  const zero = !/[1-9]/.test(text.split("e")[0]);
  const sign = scaled < 0 && !zero ? minus : style.sign && !zero ? "+" : "";
  return sign + shown + (style.unit ? `\u00a0${style.unit}` : "");
}

/** Formats a number briefly, for axes: 12k, 3.4M, 0.01. */
export function tick_text(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return "0";
  const sign = value < 0 ? minus : "";
  const trim = (x: number): string => String(Number(x.toPrecision(4)));
  if (size >= 1e9) return `${sign}${trim(size / 1e9)}G`;
  if (size >= 1e6) return `${sign}${trim(size / 1e6)}M`;
  if (size >= 1e4) return `${sign}${trim(size / 1e3)}k`;
  if (size < 1e-4) return sign + size.toExponential(0);
  return sign + trim(size);
}

/** <span data-figure="0.cycles.actual">307 068</span>: shows the value at that path of the JSON. */
export function figure(index: number, result: Result, path: Path, style: Style = {}): HTMLElement {
  const value = at(result, path);
  return h(
    "span",
    {
      class: "figure",
      "data-figure": path_text(index, path),
      "data-scale": style.scale,
      title: typeof value === "number" && style.scale === undefined ? String(value) : null,
    },
    typeof value === "string" || typeof value === "boolean" ? String(value) : number_text(value, style),
  );
}

/** `figure` of one result: figures_of(0, result)(["cycles", "actual"]). */
export function figures_of(index: number, result: Result): (path: Path, style?: Style) => HTMLElement {
  return (path, style) => figure(index, result, path, style);
}
