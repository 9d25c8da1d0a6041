// SPDX-License-Identifier: Apache-2.0
// Words and LSBs of one pixel, one row per picture; its size stays the same while the pointer moves.
import { h } from "../dom";
import { number_text } from "../figures";
import { channel_names, type Plane } from "./plane";
import type { Scene } from "./views";

function cells(plane: Plane, at: { x: number; y: number } | null): string[] {
  return channel_names.map((_, c) => {
    if (!at || c >= plane.picture.channels || !plane.holds(at.x, at.y)) return "\u2013";
    return String(plane.word(at.x, at.y, c));
  });
}

function values(plane: Plane, at: { x: number; y: number } | null): string {
  if (!at || !plane.holds(at.x, at.y)) return "\u2013";
  return channel_names
    .slice(0, plane.picture.channels)
    .map((_, c) => (plane.word(at.x, at.y, c) / plane.picture.scale).toFixed(5))
    .join(" ");
}

/** The word that stands for 1.0. */
function one_text(plane: Plane): string {
  const { scale } = plane.picture;
  return scale > 1 && Number.isInteger(Math.log2(scale)) ? `2^${Math.log2(scale)}` : String(scale);
}

function scale_text(plane: Plane): string {
  const { exact, kind } = plane.picture;
  return `${kind ?? "words"}, 1.0 = ${one_text(plane)}${exact === false ? ", rounded" : ""}`;
}

export function readout(root: HTMLElement, scene: Scene, a: string, b: string, lsb_bits: number, at: { x: number; y: number } | null): void {
  const scales = [...new Set(scene.measured.map(one_text))];
  const rounded = scene.measured.some((plane) => plane.picture.exact === false) ? " (floats rounded)" : "";
  const words = (scales.length === 1 ? `words, 1 = ${scales[0]}` : "words") + rounded;
  // The compared pictures come first, with their error, because a table with many pictures scrolls.
  const compared = (plane: Plane): boolean => plane.picture.id === a || plane.picture.id === b;
  const row_of = (plane: Plane): HTMLElement =>
    h(
      "tr",
      { "data-words": plane.picture.id },
      h("th", { scope: "row", title: scale_text(plane) }, plane.picture.title, scales.length > 1 && h("small", {}, ` 1 = ${one_text(plane)}`)),
      cells(plane, at).map((text) => h("td", { class: "num" }, text)),
      h("td", { class: "num values" }, values(plane, at)),
    );
  const rows = scene.measured.filter(compared).map(row_of);
  const pair = scene.pair(a, b);
  if (pair) {
    const [ref, test] = pair;
    const per = 2 ** lsb_bits - 1;
    const errors = channel_names.map((_, c) => {
      if (!at || c >= ref.picture.channels || !ref.holds(at.x, at.y) || !test.holds(at.x, at.y)) return null;
      return (test.word(at.x, at.y, c) / test.picture.scale - ref.word(at.x, at.y, c) / ref.picture.scale) * per;
    });
    rows.push(
      h(
        "tr",
        { "data-words": "error" },
        h("th", { scope: "row", title: `${test.picture.title} \u2212 ${ref.picture.title}` }, "Error", h("small", {}, ` LSB of ${lsb_bits} bits`)),
        errors.map((e) => h("td", { class: "num" }, e === null ? "\u2013" : number_text(e, { digits: 3, sign: true }))),
        h("td", { class: "num values" }, `${test.picture.title} \u2212 ${ref.picture.title}`),
      ),
    );
  }
  rows.push(...scene.measured.filter((plane) => !compared(plane)).map(row_of));
  root.replaceChildren(
    h(
      "table",
      {},
      h("caption", { "data-at": at ? `${at.x},${at.y}` : "" }, at ? `Pixel (${at.x}, ${at.y}), ${words}` : `Point at a pixel, or click one: ${words}`),
      h("thead", {}, h("tr", {}, h("th", {}, "Picture"), channel_names.map((name) => h("th", { class: "num" }, name)), h("th", { class: "num" }, "Values"))),
      h("tbody", {}, rows),
    ),
  );
}
