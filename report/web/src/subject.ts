// SPDX-License-Identifier: Apache-2.0
// The subject of a result: scan, configuration and picture size. Every heading names it, so that figures of different
// runs cannot be confused.
import { h, type Child } from "./dom";
import type { Picture, Result } from "./page";

export interface Subject {
  scans: string[];
  configs: string[];
  sizes: string[];
}

const base = (path: string): string => path.replace(/.*\//, "");
export const size_text = (width: unknown, height: unknown): string => `${String(width)} \u00d7 ${String(height)} pixels`;

class Collected implements Subject {
  scans: string[] = [];
  configs: string[] = [];
  sizes: string[] = [];

  private add(to: string[], text: unknown): void {
    if (typeof text === "string" && text !== "" && !to.includes(text)) to.push(text);
  }
  scan(text: unknown): void {
    this.add(this.scans, typeof text === "string" ? base(text) : text);
  }
  config(of: Result): void {
    this.add(this.configs, typeof of === "string" ? of : of?.name);
  }
  size(width: unknown, height: unknown): void {
    if (typeof width === "number" && typeof height === "number") this.add(this.sizes, size_text(width, height));
  }

  /** The text of a scene file, as in results of `render` and in pictures. */
  toml(text: string): void {
    const volume = /^volume = "(.*)"$/m.exec(text), image = /\[image\][^[]*?width = (\d+)\s+height = (\d+)/.exec(text);
    const post = /\[classify\][^[]*?order = "post"/.test(text);
    if (volume) this.scan(base(volume[1]) + (post ? ", classified by pixel" : ""));
    if (image) this.size(Number(image[1]), Number(image[2]));
  }

  /** "ch2bet 181x217x181, mri-head, image_aligned, 128x128 pixels". */
  summary(text: string): void {
    const size = /(\d+)x(\d+) pixels/.exec(text);
    this.scan(text.split(",")[0].replace(/ \d+x\d+x\d+$/, ""));
    if (size) this.size(Number(size[1]), Number(size[2]));
  }

  scene(scene: Result): void {
    if (typeof scene === "string") this.summary(scene);
    else if (typeof scene?.toml === "string") this.toml(scene.toml);
    else if (scene?.scene) this.scene(scene.scene);
    else if (scene) {
      this.scan(scene.volume ?? scene.source ?? scene.name);
      this.size(scene.width, scene.height);
    }
  }

  /** Uses a command's flags for what the result does not contain. */
  command(text: Result): void {
    if (typeof text !== "string") return;
    const all = (flag: string): string[] => [...text.matchAll(new RegExp(`--${flag}[ =]'?([^\\s']+)`, "g"))].map((found) => found[1]);
    if (!this.scans.some((scan) => !/ cases$/.test(scan))) for (const flag of ["volume", "gaussians", "stream", "scene"]) all(flag).forEach((name) => this.scan(name));
    if (!this.configs.length) all("config").forEach((name) => this.config(name.replace(/.*\/|\.toml$/g, "")));
    if (!this.sizes.length) all("size").forEach((side) => this.size(Number(side), Number(side)));
  }
}

export function subject_of(results: Result[]): Subject {
  const subject = new Collected();
  for (const result of results) {
    const one = new Collected();
    for (const scene of [result.scene, result.gaussians, ...(result.scenes ?? [])]) if (scene) one.scene(scene);
    for (const side of [result.ref, result.test]) {
      if (side?.metadata?.scene) one.toml(side.metadata.scene);
      one.scan(side?.metadata?.gaussians);
      one.config(side?.metadata?.config);
    }
    one.config(result.config ?? result.from);
    for (const on of result.configurations ?? []) one.config(on.config);
    if (!one.sizes.length || result.ref) {
      if (result.ref) one.sizes = [];
      one.size(result.width, result.height);
    }
    if (!one.scans.length) one.scan(result.stream);
    if (result.rows) one.scan(`${String(result.rows.length)} cases`);
    for (const row of [result, ...(result.rows ?? [])]) one.command(row?.command);
    if (!one.scans.length && result.ref) for (const side of [result.ref, result.test]) one.scan(side?.file);
    if (!one.scans.length && result.streams > 0) one.scan(result.streams === 1 ? "1 stream" : `${String(result.streams)} streams`);
    one.scans.forEach((scan) => subject.scan(scan));
    one.configs.forEach((config) => subject.config(config));
    one.sizes.filter((size) => !subject.sizes.includes(size)).forEach((size) => subject.sizes.push(size));
  }
  return subject;
}

export function subject_of_pictures(pictures: Picture[]): Subject {
  const subject = new Collected();
  for (const { scene, volume, gaussians, config, crop, width, height, display } of pictures) {
    if (scene) subject.toml(scene);
    else subject.scan(volume ?? gaussians);
    subject.config(config);
    if (!scene && !display) subject.size(crop?.full_width ?? width, crop?.full_height ?? height);
  }
  return subject;
}

/** Lists up to four entries; of more, only their number. */
function listed(all: string[], one: string, many: string): string[] {
  return all.length > 4 ? [`${all.length} ${many}`] : all.map((each, i) => (i === 0 && one ? `${all.length > 1 ? many : one} ${each}` : each));
}

function parts(subject: Subject): [keyof Subject, string][] {
  return [
    ...listed(subject.scans, "", "scans").map((text): [keyof Subject, string] => ["scans", text]),
    ...listed(subject.configs, "configuration", "configurations").map((text): [keyof Subject, string] => ["configs", text]),
    ...listed(subject.sizes, "", "sizes").map((text): [keyof Subject, string] => ["sizes", text]),
  ];
}

export function subject_text(subject: Subject): string {
  return parts(subject).map(([, text]) => text).join(", ");
}

/** Entries of `subject` that differ from `than`, for kinds that `than` has. */
export function differing(subject: Subject, than: Subject): string[] {
  return (["scans", "configs", "sizes"] as const).flatMap((key) => (than[key].length ? subject[key].filter((text) => !than[key].includes(text)) : []));
}

/** The subject's text, with differences from `than` in bold. */
export function subject_line(subject: Subject, than: Subject): Child[] {
  const other = differing(subject, than);
  return parts(subject).map(([key, text], i) => [i ? ", " : "", subject[key].some((each) => other.includes(each) && text.includes(each)) ? h("strong", {}, text) : text]);
}
