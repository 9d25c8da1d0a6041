// SPDX-License-Identifier: Apache-2.0
// Pictures computed in the page from words: signed error in LSB, saturation.
import { painted, type Channel, type Plane } from "./plane";

export interface Difference {
  /** The window common to both pictures. */
  x0: number;
  y0: number;
  width: number;
  height: number;
  /** Signed error TEST - REF, in LSB: of the channel, or of the channel with the largest error. */
  lsb: Float32Array;
  /** Largest magnitude and its pixel, the first in row order. */
  max: number;
  worst: { x: number; y: number };
}

export function comparable(ref: Plane, test: Plane): boolean {
  return (
    ref.full_width === test.full_width &&
    ref.full_height === test.full_height &&
    ref.picture.channels === test.picture.channels &&
    !!ref.picture.display === !!test.picture.display
  );
}

export function difference(ref: Plane, test: Plane, channel: Channel, lsb_bits: number): Difference {
  const x0 = Math.max(ref.x0, test.x0), y0 = Math.max(ref.y0, test.y0);
  const width = Math.min(ref.x0 + ref.picture.width, test.x0 + test.picture.width) - x0;
  const height = Math.min(ref.y0 + ref.picture.height, test.y0 + test.picture.height) - y0;
  const lsb = new Float32Array(Math.max(0, width * height));
  const per_ref = (2 ** lsb_bits - 1) / ref.picture.scale, per_test = (2 ** lsb_bits - 1) / test.picture.scale;
  const { channels } = ref.picture;
  const first = channel === "colour" ? 0 : Math.min(Number(channel), channels - 1);
  const last = channel === "colour" ? channels : first + 1;
  let max = 0, at_worst = 0;
  for (let y = 0, to = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x, ++to) {
      let worst = 0;
      for (let c = first; c < last; ++c) {
        const e = test.word(x0 + x, y0 + y, c) * per_test - ref.word(x0 + x, y0 + y, c) * per_ref;
        if (Math.abs(e) > Math.abs(worst)) worst = e;
      }
      lsb[to] = worst;
      if (Math.abs(worst) > max) {
        max = Math.abs(worst);
        at_worst = to;
      }
    }
  }
  return { x0, y0, width, height, lsb, max, worst: { x: x0 + (at_worst % Math.max(1, width)), y: y0 + Math.floor(at_worst / Math.max(1, width)) } };
}

/** Blue below, light grey at 0, red above; full colour at `range` LSB. */
export function error_colour(lsb: number, range: number): [number, number, number] {
  const t = Math.max(-1, Math.min(1, lsb / range));
  const end = t < 0 ? [0, 60, 160] : [176, 24, 16];
  const k = Math.abs(t) ** 0.7; // makes small errors visible
  return [0, 1, 2].map((c) => Math.round(232 + (end[c] - 232) * k)) as [number, number, number];
}

export function drawn_difference(d: Difference, range: number): HTMLCanvasElement {
  return painted(Math.max(1, d.width), Math.max(1, d.height), (pixels) => {
    d.lsb.forEach((e, i) => pixels.set(error_colour(e, range), 4 * i));
  });
}

/** Rounds up to 0.5, 1, 2, 5, 10... */
export function round_range(max: number): number {
  if (!(max > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(max));
  return [1, 2, 5, 10].map((k) => k * power).find((value) => value >= max * 0.999) ?? max;
}

/** Marks pixels with a colour at the format's largest word in orange, with only alpha there (opaque) in blue; others
 *  are dark grey by brightness. */
export function drawn_saturation(plane: Plane): { canvas: HTMLCanvasElement; colours: number; opaque: number } {
  const { width, height, channels } = plane.picture;
  const top = plane.top_word;
  let colours = 0, opaque = 0;
  const canvas = painted(width, height, (pixels) => {
    for (let i = 0, at = 0; i < width * height; ++i, at += channels) {
      let at_top = false;
      for (let c = 0; c < Math.min(3, channels); ++c) at_top ||= plane.words[at + c] >= top;
      const alpha = channels === 4 && plane.words[at + 3] >= top;
      const grey = 30 + Math.round((60 * Math.min(plane.words[at + Math.min(1, channels - 1)], top)) / Math.max(1, top));
      colours += at_top ? 1 : 0;
      opaque += !at_top && alpha ? 1 : 0;
      pixels.set(at_top ? [230, 159, 0] : alpha ? [0, 84, 138] : [grey, grey, grey], 4 * i);
    }
  });
  return { canvas, colours, opaque };
}
