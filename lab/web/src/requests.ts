// SPDX-License-Identifier: Apache-2.0
// A state as the engine's request.
import type { Request, Tables } from "./answers";
import type { Lab } from "./lab_state";

/** A short hash of a text, for names of files. */
export function short_hash(text: string): string {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193);
  return (hash >>> 0).toString(16).padStart(8, "0");
}

export function tf_file(lab: Lab): string {
  return `tf-${short_hash(lab.tf_toml)}.toml`;
}

/** The engine reports which settings have no effect only of those that are given. So every setting is given, except
 *  those whose default depends on others. None of these has an effect on Gaussians. */
const only_if_changed = (name: string): boolean => name.startsWith("kernel.") || name === "crop" || name.startsWith("image.");

/** The size of a picture whose larger side is at most `most`. */
export function reduced(lab: Lab, most: number): { width: number; height: number } {
  const scale = Math.min(1, most / Math.max(lab.width, lab.height));
  return { width: Math.max(1, Math.round(lab.width * scale)), height: Math.max(1, Math.round(lab.height * scale)) };
}

export function request_of(tables: Tables, lab: Lab, ask: Request["ask"], size: { width: number; height: number } = lab): Request {
  const settings: Record<string, string> = {};
  for (const { name, default: value } of tables.settings) if (lab.gaussians || !only_if_changed(name)) settings[name] = value;
  Object.assign(settings, lab.settings, { "image.width": String(size.width), "image.height": String(size.height) });
  return {
    ask,
    volume: lab.volume,
    gaussians: lab.gaussians,
    tf: lab.tf_toml ? `/files/${tf_file(lab)}` : lab.tf,
    kernel: lab.kernel,
    settings,
    ...(lab.toml ? { toml: lab.toml } : { config: lab.config }),
    changes: Object.entries(lab.changes).map(([key, value]) => `${key}=${value}`),
  };
}

/** Equal for states that differ only in the device. */
export function scene_key(lab: Lab): string {
  const { config: _config, toml: _toml, changes: _changes, ...scene } = lab;
  return JSON.stringify(scene);
}

/** Equal for states with the same volume and transfer function. */
export function tf_key(lab: Lab): string {
  return JSON.stringify([lab.volume, lab.gaussians, lab.tf, lab.tf_toml]);
}

export function device_key(lab: Lab): string {
  return JSON.stringify([lab.toml || lab.config, Object.entries(lab.changes).sort()]);
}
