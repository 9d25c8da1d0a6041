// SPDX-License-Identifier: Apache-2.0
// A picture in memory: words, values, and its rendering.
import type { Words } from "../codec";
import type { Picture } from "../page";

export type Channel = "colour" | "0" | "1" | "2" | "3";
export const channel_names = ["R", "G", "B", "A"];

/** sRGB-encodes a linear value, as in the display PNGs. */
function encoded(linear: number): number {
  const v = Math.min(1, Math.max(0, linear));
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
}

/** 8-bit sRGB for the words up to 1.0, kept for each scale: pictures of a sequence share it. `plain`: words are sRGB. */
const tables = new Map<string, Uint8Array>();

function looks_of(scale: number, plain: boolean): Uint8Array {
  const steps = Math.min(scale, 65536);
  const key = `${steps} ${plain}`;
  let looks = tables.get(key);
  if (!looks) tables.set(key, (looks = Uint8Array.from({ length: steps + 1 }, (_, i) => (plain ? Math.round((255 * i) / steps) : encoded(i / steps)))));
  return looks;
}

export class Plane {
  readonly x0: number;
  readonly y0: number;
  readonly full_width: number;
  readonly full_height: number;
  private readonly looks: Uint8Array;

  constructor(
    readonly picture: Picture,
    readonly words: Words,
  ) {
    const { crop, width, height, scale, display, encoded } = picture;
    this.x0 = crop?.x ?? 0;
    this.y0 = crop?.y ?? 0;
    this.full_width = crop?.full_width ?? width;
    this.full_height = crop?.full_height ?? height;
    this.looks = looks_of(scale, display === true || encoded === true);
  }

  /** Whether the picture contains this pixel of the whole frame. */
  holds(x: number, y: number): boolean {
    return x >= this.x0 && y >= this.y0 && x < this.x0 + this.picture.width && y < this.y0 + this.picture.height;
  }

  word(x: number, y: number, channel: number): number {
    return this.words[((y - this.y0) * this.picture.width + (x - this.x0)) * this.picture.channels + channel];
  }

  private look(word: number): number {
    const { scale } = this.picture;
    if (word <= 0) return 0;
    return this.looks[word >= scale ? this.looks.length - 1 : scale <= 65536 ? word : Math.round((word / scale) * 65536)];
  }

  /** Draws colours over black, or one channel in grey. Opaque: alpha is shown as data, not as transparency. */
  drawn(channel: Channel): HTMLCanvasElement {
    const { width, height, channels } = this.picture;
    return painted(width, height, (pixels) => {
      const one = channel === "colour" ? -1 : Number(channel);
      for (let i = 0, at = 0, to = 0; i < width * height; ++i, at += channels, to += 4) {
        for (let c = 0; c < 3; ++c) {
          const from = one >= 0 ? Math.min(one, channels - 1) : channels < 3 ? 0 : c;
          pixels[to + c] = this.look(this.words[at + from]);
        }
      }
    });
  }

  /** The largest word of the device's format; 0 if unknown. */
  get top_word(): number {
    const { int_bits, frac_bits } = this.picture;
    return typeof int_bits === "number" && typeof frac_bits === "number" ? 2 ** (int_bits + frac_bits) - 1 : 0;
  }
}

/** A canvas of that size; `paint` fills its RGBA bytes, whose alpha is already 255. */
export function painted(width: number, height: number, paint: (pixels: Uint8ClampedArray) => void): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const image = new ImageData(width, height);
  for (let i = 3; i < image.data.length; i += 4) image.data[i] = 255;
  paint(image.data);
  canvas.getContext("2d")?.putImageData(image, 0, 0);
  return canvas;
}
