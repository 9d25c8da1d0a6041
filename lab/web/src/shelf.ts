// SPDX-License-Identifier: Apache-2.0
// The files that the engines see under /files: transfer functions by their hash, and volumes, of which the oldest go when
// all of them would take too much memory.
import type { Engine, Files } from "./engine";
import type { Lab } from "./lab_state";
import { tf_file } from "./requests";

interface Volume {
  path: string;
  names: string[];
  bytes: number;
}

export class Shelf {
  private volumes: Volume[] = [];
  private drops = 0;

  constructor(
    private readonly files: Files,
    private readonly engines: Engine[],
    private readonly most_bytes: number,
  ) {}

  has(name: string): boolean {
    return this.files.has(name);
  }

  private add(name: string, blob: Blob): void {
    this.files.set(name, blob);
    for (const engine of this.engines) engine.add_file(name, blob);
  }

  /** Adds the transfer function of a state, if it has one of its own. */
  prepare(lab: Lab): void {
    if (lab.tf_toml && !this.has(tf_file(lab))) this.add(tf_file(lab), new Blob([lab.tf_toml]));
  }

  /** Adds the files of one drop, the one to show first, to a folder of their own: the engine keeps volumes by path, and a
   *  header finds its data. Returns the first one's path. */
  add_volume(parts: { name: string; blob: Blob }[]): string {
    const folder = `${++this.drops}/`;
    const names = parts.map((part) => folder + part.name);
    parts.forEach((part, i) => this.add(names[i], part.blob));
    const path = `/files/${names[0]}`;
    this.volumes.push({ path, names, bytes: parts.reduce((sum, part) => sum + part.blob.size, 0) });
    while (this.volumes.length > 1 && this.volumes.reduce((sum, each) => sum + each.bytes, 0) > this.most_bytes) this.remove(this.volumes[0].path);
    return path;
  }

  remove(path: string): void {
    const volume = this.volumes.find((each) => each.path === path);
    this.volumes = this.volumes.filter((each) => each !== volume);
    for (const name of volume?.names ?? []) {
      this.files.delete(name);
      for (const engine of this.engines) engine.remove_file(name);
    }
  }
}
