// SPDX-License-Identifier: Apache-2.0
// What the page shows: a scene and a device, with undo and redo. States are never changed, only replaced.

export interface Lab {
  volume: string;
  /** Drawn in place of the volume; "" for none. */
  gaussians: string;
  /** A preset's name; "" lets the program choose. */
  tf: string;
  /** A transfer function as TOML, in place of `tf`. */
  tf_toml: string;
  kernel: string;
  width: number;
  height: number;
  /** Settings that differ from their defaults, as flags take them. */
  settings: Record<string, string>;
  config: string;
  /** A configuration as TOML, in place of `config`. */
  toml: string;
  /** Keys that differ from the configuration. */
  changes: Record<string, string>;
}

/** A record with one value changed, or without it if `value` is null. */
export function changed(from: Record<string, string>, name: string, value: string | null): Record<string, string> {
  const { [name]: _, ...rest } = from;
  return value === null ? rest : { ...rest, [name]: value };
}

export interface Change {
  /** Whether the user is still dragging. */
  live: boolean;
}

/** Changes of one control within this time are one step of undo. */
const together_ms = 1000;

export class Store {
  private past: Lab[] = [];
  private future: Lab[] = [];
  private merged = { key: "", at: 0 };
  private listeners: ((lab: Lab, change: Change) => void)[] = [];

  constructor(private state: Lab) {}

  get now(): Lab {
    return this.state;
  }

  get can_undo(): boolean {
    return this.past.length > 0;
  }

  get can_redo(): boolean {
    return this.future.length > 0;
  }

  on(listener: (lab: Lab, change: Change) => void): void {
    this.listeners.push(listener);
  }

  /** Changes the state. Successive changes with the same `merge` are undone together. */
  set(part: Partial<Lab>, merge = "", live = false): void {
    const now = performance.now();
    if (JSON.stringify({ ...this.state, ...part }) === JSON.stringify(this.state)) {
      if (!live) this.tell({ live });
      return;
    }
    const same = merge !== "" && merge === this.merged.key && now - this.merged.at < together_ms;
    if (!same) this.past.push(this.state);
    if (this.past.length > 500) this.past.shift();
    this.merged = { key: merge, at: now };
    this.future = [];
    this.state = { ...this.state, ...part };
    this.tell({ live });
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private step(from: Lab[], to: Lab[]): void {
    const next = from.pop();
    if (!next) return;
    to.push(this.state);
    this.state = next;
    this.merged = { key: "", at: 0 };
    this.tell({ live: false });
  }

  private tell(change: Change): void {
    for (const listener of this.listeners) listener(this.state, change);
  }
}
