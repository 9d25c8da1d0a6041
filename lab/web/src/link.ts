// SPDX-License-Identifier: Apache-2.0
// The address holds the state: "#lab?volume=...&view=...". The engine reads it back.
import type { Request } from "./answers";
import type { Lab } from "./lab_state";

const prefix = "#lab?";
const setting = "s.";
const change = "k.";

/** The address's part after the file's name. `view` is the viewer's own link. */
export function link_of(lab: Lab, view: string): string {
  const words = new URLSearchParams({ volume: lab.volume, kernel: lab.kernel, config: lab.config, size: `${lab.width}x${lab.height}` });
  for (const name of ["gaussians", "tf", "tf_toml", "toml"] as const) if (lab[name]) words.set(name, lab[name]);
  for (const [name, value] of Object.entries(lab.settings)) words.set(setting + name, value);
  for (const [name, value] of Object.entries(lab.changes)) words.set(change + name, value);
  if (view) words.set("view", view.replace(/^#pictures\?/, ""));
  return prefix + words.toString().replaceAll("%2C", ",").replaceAll("%3A", ":");
}

/** What the engine is asked for the state of an address; an address without one holds the first state. */
export function link_request(hash: string): Request {
  return { ask: "link", link: hash.startsWith(prefix) ? hash : "" };
}

/** The state of an answer, and a notice about what the address has and the state has not. */
export function state_of({ ignored, ...lab }: Lab & { ignored?: string[] }): { lab: Lab; notice: string } {
  return { lab, notice: ignored ? `Not followed in this link: ${ignored.join(", ")}` : "" };
}

/** The configuration's hash, if the address has it: a report's does. */
export function hash_of_link(hash: string): string {
  return (hash.startsWith(prefix) && new URLSearchParams(hash.slice(prefix.length)).get("config_hash")) || "";
}

export function view_of_link(hash: string): string {
  const view = hash.startsWith(prefix) ? new URLSearchParams(hash.slice(prefix.length)).get("view") : null;
  return view ? `#pictures?${view}` : "";
}
