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

  /** Adds a volume: the first file, and the ones that it names. Returns its path. */
  add_volume(parts: { name: string; blob: Blob }[]): string {
    let { name } = parts[0];
    // The engine keeps volumes by name, so another file of the same name gets another one.
    while (this.has(name)) name = `again-${name}`;
    const all = [{ name, blob: parts[0].blob }, ...parts.slice(1)];
    for (const part of all) this.add(part.name, part.blob);
    const path = `/files/${name}`;
    this.volumes.push({ path, names: all.map((part) => part.name), bytes: all.reduce((sum, part) => sum + part.blob.size, 0) });
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
