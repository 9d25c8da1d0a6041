// SPDX-License-Identifier: Apache-2.0
// The address holds the state: "#lab?volume=...&view=..." and back.
import type { Tables } from "./answers";
import { first_lab, type Lab } from "./lab_state";

const prefix = "#lab?";
const setting = "s.";
const change = "k.";

/** The address's part after the file's name. `view` is the viewer's own link. */
export function link_of(lab: Lab, view: string): string {
  const words = new URLSearchParams({ volume: lab.volume, config: lab.config, size: `${lab.width}x${lab.height}` });
  for (const name of ["tf", "tf_toml", "toml"] as const) if (lab[name]) words.set(name, lab[name]);
  if (lab.kernel !== first_lab.kernel) words.set("kernel", lab.kernel);
  for (const [name, value] of Object.entries(lab.settings)) words.set(setting + name, value);
  for (const [name, value] of Object.entries(lab.changes)) words.set(change + name, value);
  if (view) words.set("view", view.replace(/^#pictures\?/, ""));
  return prefix + words.toString().replaceAll("%2C", ",").replaceAll("%3A", ":");
}

/** The state of an address; null if it holds none. Unknown names are left out. */
export function from_link(hash: string, tables: Tables): Lab | null {
  if (!hash.startsWith(prefix)) return null;
  const words = new URLSearchParams(hash.slice(prefix.length));
  const size = /^(\d{1,5})x(\d{1,5})$/.exec(words.get("size") ?? "");
  const lab: Lab = { ...first_lab, settings: {}, changes: {} };
  for (const name of ["volume", "tf", "tf_toml", "kernel", "config", "toml"] as const) lab[name] = words.get(name) ?? first_lab[name];
  if (size) Object.assign(lab, { width: clamped(Number(size[1])), height: clamped(Number(size[2])) });
  for (const { name } of tables.settings) {
    const value = words.get(setting + name);
    if (value !== null) lab.settings[name] = value;
  }
  for (const { name } of tables.keys) {
    const value = words.get(change + name);
    if (value !== null) lab.changes[name] = value;
  }
  return lab;
}

export function view_of_link(hash: string): string {
  const view = hash.startsWith(prefix) ? new URLSearchParams(hash.slice(prefix.length)).get("view") : null;
  return view ? `#pictures?${view}` : "";
}

/** Sides of pictures that the page draws. */
export const most_side = 1024;
export function clamped(side: number): number {
  return Math.min(most_side, Math.max(16, Math.round(side) || first_lab.width));
}
