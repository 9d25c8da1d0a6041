// SPDX-License-Identifier: Apache-2.0
// The views of one scene: its pictures, and differences that the page computes from the words of two pictures.
import { comparable, difference, drawn_difference, drawn_saturation, round_range, type Difference } from "./derived";
import { type Channel, type Plane } from "./plane";

export interface View {
  key: string;
  title: string;
  /** Frame coordinates of its top left corner, and picture pixels per frame pixel. */
  x0: number;
  y0: number;
  factor: number;
  /** Rows of the frame; a legend below them is shown separately. */
  rows: number;
  image: HTMLCanvasElement;
  /** Text below the picture. */
  note?: string;
}

export class Scene {
  private readonly images = new Map<string, View>();
  private last: { key: string; difference: Difference } | null = null;
  readonly width: number;
  readonly height: number;

  constructor(readonly planes: Plane[]) {
    const frame = this.measured[0] ?? planes[0];
    this.width = frame.full_width;
    this.height = frame.full_height;
  }

  get measured(): Plane[] {
    return this.planes.filter((plane) => !plane.picture.display);
  }

  plane(id: string): Plane | undefined {
    return this.planes.find((plane) => plane.picture.id === id);
  }

  keys(a: string, b: string): string[] {
    const keys = this.planes.map((plane) => plane.picture.id);
    if (this.pair(a, b)) keys.push("error");
    for (const plane of this.measured) if (plane.top_word > 0) keys.push(`saturation-${plane.picture.id}`);
    return keys;
  }

  pair(a: string, b: string): [Plane, Plane] | null {
    const ref = this.plane(a), test = this.plane(b);
    return ref && test && ref !== test && comparable(ref, test) ? [ref, test] : null;
  }

  /** Reference and test of a compare's result, which are shown initially. */
  get compared(): [string, string] | null {
    for (const ref of this.measured)
      for (const place of ref.picture.compared ?? []) {
        const test = place.endsWith(".ref") ? this.measured.find((plane) => plane.picture.compared?.includes(place.replace(/ref$/, "test"))) : undefined;
        if (test && this.pair(ref.picture.id, test.picture.id)) return [ref.picture.id, test.picture.id];
      }
    return null;
  }

  difference(a: string, b: string, channel: Channel, lsb_bits: number): Difference | null {
    const planes = this.pair(a, b);
    if (!planes) return null;
    const key = [a, b, channel, lsb_bits].join();
    if (this.last?.key !== key) this.last = { key, difference: difference(...planes, channel, lsb_bits) };
    return this.last.difference;
  }

  view(key: string, a: string, b: string, channel: Channel, lsb_bits: number, range: number): View | null {
    const id = key === "error" ? [key, a, b, channel, lsb_bits, range].join() : [key, channel].join();
    let view = this.images.get(id) ?? null;
    if (!view) {
      view = key === "error" ? this.error(a, b, channel, lsb_bits, range) : this.picture(key, channel);
      if (view) this.images.set(id, view);
      if (this.images.size > 24) this.images.delete(this.images.keys().next().value as string);
    }
    return view;
  }

  private error(a: string, b: string, channel: Channel, lsb_bits: number, range: number): View | null {
    const d = this.difference(a, b, channel, lsb_bits);
    const planes = this.pair(a, b);
    if (!d || !planes) return null;
    const title = `Error: ${planes[1].picture.title} \u2212 ${planes[0].picture.title}`;
    const image = drawn_difference(d, range > 0 ? range : round_range(d.max));
    return { key: "error", title, x0: d.x0, y0: d.y0, factor: 1, rows: this.height, image };
  }

  private picture(key: string, channel: Channel): View | null {
    const saturation = key.startsWith("saturation-");
    const plane = this.plane(saturation ? key.slice("saturation-".length) : key);
    if (!plane) return null;
    const { title, width, height, note } = plane.picture;
    const place = { key, x0: plane.x0, y0: plane.y0, factor: 1, rows: this.height };
    if (saturation) {
      const { canvas, colours, opaque } = drawn_saturation(plane);
      const counts = `Orange: ${colours} pixels with a colour at the last word, ${plane.top_word}. Blue: ${opaque} opaque ones.`;
      return { ...place, title: `Saturation: ${title}`, image: canvas, note: counts };
    }
    // Display maps may have another size: they are as wide as the frame and have a legend below.
    const factor = plane.picture.display ? width / this.width : 1;
    return { ...place, title, factor, rows: plane.picture.display ? this.height : height, image: plane.drawn(channel), note };
  }
}
