// SPDX-License-Identifier: Apache-2.0
// What a state draws, a volume or 3-D Gaussians, as one word.
import type { Tables } from "./answers";
import { changed, type Lab } from "./lab_state";

const mark = "gaussians ";

/** The word for a built-in scene or a file's path. */
export const word_of = (name: string, gaussians: boolean): string => (gaussians ? mark + name : name);
export const subject_of = (lab: Lab): string => (lab.gaussians ? word_of(lab.gaussians, true) : lab.volume);
/** The path or built-in name. */
export const name_of = (subject: string): string => subject.replace(mark, "");
/** Without the page's own folders. */
export const shown_name = (subject: string): string => name_of(subject).replace(/^\/files\/(\d+\/)?/, "");

/** The change to another subject. Gaussians need a device that composites every sample of ellipses. */
export function to_subject(lab: Lab, subject: string, tables: Tables): Partial<Lab> {
  const gaussians = subject.startsWith(mark);
  const of = gaussians ? { gaussians: name_of(subject) } : { volume: subject, gaussians: "" };
  if (gaussians === (lab.gaussians !== "")) return of;
  const device = gaussians ? { config: tables.gaussian_config, changes: tables.gaussian_changes } : { config: "base", changes: {} };
  return { ...of, ...device, toml: "", settings: changed(lab.settings, "camera.projection", gaussians ? "perspective" : null) };
}
