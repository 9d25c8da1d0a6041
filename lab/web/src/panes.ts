// SPDX-License-Identifier: Apache-2.0
// The pictures of a frame in the report's viewer, which keeps its state from frame to frame.
import { h } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import type { Picture } from "../../../report/web/src/page";
import { Plane } from "../../../report/web/src/viewer/plane";
import type { Address } from "../../../report/web/src/viewer/state";
import { Viewer, type Tour } from "../../../report/web/src/viewer/viewer";
import { Scene } from "../../../report/web/src/viewer/views";
import type { Answer, Frame } from "./answers";
import { drawn_sheets } from "./terminated";

type Pictures = Answer["pictures"];

const titles: Record<string, string> = { golden: "Golden", device: "Device", blame: "Blame map", terminated: "Terminated pixels" };
/** Maps for display: no words of a frame. */
const maps = new Set(["blame", "terminated"]);

function plane(from: Pictures[0]): Plane {
  const { head, words, note } = from.head.id === "terminated" ? drawn_sheets(from) : { ...from, note: undefined };
  const bits = Math.log2(head.scale);
  const picture: Picture = {
    id: head.id,
    role: head.id,
    title: titles[head.id] ?? head.id,
    width: head.width,
    height: head.height,
    channels: head.channels,
    codec: "",
    scale: head.scale,
    frac_bits: Number.isInteger(bits) ? bits : null,
    int_bits: head.int_bits < 0 ? null : head.int_bits,
    exact: head.int_bits >= 0,
    encoded: head.encoded,
    display: maps.has(head.id),
    note,
    sha256: "",
    from: "",
  };
  return new Plane(picture, words);
}

/** The places that a comparison points out, as in the report. */
function tour_of(frame: Frame): Tour {
  const { compare } = frame;
  const tour: Tour = { lsb_bits: compare?.lsb_bits ?? 8, worst: null, clusters: [], none: frame.device_error ? "The device drew nothing." : "No cluster: no pixel errs by 1 LSB or more." };
  if (compare?.worst) {
    const { x, y, error_lsb } = compare.worst;
    tour.worst = { label: `Worst pixel (${x}, ${y}): ${number_text(error_lsb)} LSB`, x, y };
  }
  tour.clusters = (compare?.clusters ?? []).slice(0, 6).map((cluster: { pixels: number; max_lsb: number; worst: { x: number; y: number } }, i: number) => ({
    label: `Cluster ${i + 1}: ${number_text(cluster.pixels)} px, ${number_text(cluster.max_lsb)} LSB`,
    x: cluster.worst.x,
    y: cluster.worst.y,
  }));
  return tour;
}

export class Panes {
  readonly root = h("div", { class: "panes-root" });
  private viewer: Viewer | null = null;
  private frame: Frame | null = null;
  private pictures: Pictures = [];
  private maps: Pictures = [];

  constructor(private readonly address: Address) {}

  /** The viewer's link; "" before the first frame. */
  get link(): string {
    return this.viewer?.link ?? "";
  }

  show(frame: Frame, pictures: Pictures): void {
    this.frame = frame;
    this.pictures = pictures;
    this.maps = [];
    this.draw();
  }

  /** Adds a map to the frame. */
  show_map(picture: Pictures[0]): void {
    this.maps = [...this.maps.filter(({ head }) => head.id !== picture.head.id), picture];
    this.draw();
    this.viewer?.present(picture.head.id);
  }

  private draw(): void {
    const scenes = [{ name: "", scene: new Scene([...this.pictures, ...this.maps].map(plane)) }];
    if (this.viewer) this.viewer.replace(scenes);
    else this.viewer = new Viewer(this.root, scenes, () => tour_of(this.frame as Frame), this.address);
  }
}
