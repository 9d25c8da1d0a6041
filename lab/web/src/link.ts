// SPDX-License-Identifier: Apache-2.0
// The address holds the state: "#lab?volume=...&view=...". The engine reads it back.
import type { Request } from "./answers";
import type { Lab } from "./lab_state";

const prefix = "#lab?";
const setting = "s.";
const change = "k.";

/** The address's part after the file's name. `view` is the viewer's own link. */
export function link_of(lab: Lab, view: string): string {
  const words = new URLSearchParams({ volume: lab.volume, config: lab.config, size: `${lab.width}x${lab.height}` });
  for (const name of ["gaussians", "tf", "tf_toml", "toml"] as const) if (lab[name]) words.set(name, lab[name]);
  if (lab.kernel !== "gauss2") words.set("kernel", lab.kernel);
  for (const [name, value] of Object.entries(lab.settings)) words.set(setting + name, value);
  for (const [name, value] of Object.entries(lab.changes)) words.set(change + name, value);
  if (view) words.set("view", view.replace(/^#pictures\?/, ""));
  return prefix + words.toString().replaceAll("%2C", ",").replaceAll("%3A", ":");
}

/** What the engine is asked for the state of an address; an address without one holds the first state. */
export function link_request(hash: string): Request {
  return { ask: "link", link: hash.startsWith(prefix) ? hash : "" };
}

/** The configuration's hash, if the address has it: a report's does. */
export function hash_of_link(hash: string): string {
  return (hash.startsWith(prefix) && new URLSearchParams(hash.slice(prefix.length)).get("config_hash")) || "";
}

export function view_of_link(hash: string): string {
  const view = hash.startsWith(prefix) ? new URLSearchParams(hash.slice(prefix.length)).get("view") : null;
  return view ? `#pictures?${view}` : "";
}

/** Sides of pictures that the page draws. */
export const most_side = 1024;
export function clamped(side: number): number {
  return Math.min(most_side, Math.max(16, Math.round(side) || 256));
}
