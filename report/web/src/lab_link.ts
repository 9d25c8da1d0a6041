// SPDX-License-Identifier: Apache-2.0
// Links to the lab's page, lab.html beside the report: the scenes and configurations of the report's pictures.
import { h } from "./dom";
import type { Picture } from "./page";
import { subject_of_pictures, subject_text } from "./subject";

/** The lab reads the scene's file and says if its configuration of that name has another hash. */
function address({ scene = "", lab, config, config_hash = "" }: Picture): string {
  return `lab.html#lab?${lab ?? new URLSearchParams({ scene })}&${new URLSearchParams(config ? { config, config_hash } : {})}`;
}

/** A line with the links; null if no picture has a scene. */
export function lab_links(pictures: Picture[]): HTMLElement | null {
  const scene_of = (one: Picture) => one.scene ?? one.lab;
  const scenes = pictures.filter(scene_of);
  // A golden picture shares its link with the device's of the same scene.
  const devices = scenes.filter((one) => one.config || !scenes.some((other) => other.config && scene_of(other) === scene_of(one)));
  const links = new Map(devices.map((picture) => [address(picture), subject_text(subject_of_pictures([picture]))]));
  if (!links.size) return null;
  return h(
    "p",
    { class: "note", id: "open-in-lab" },
    "Open in the lab: ",
    [...links].flatMap(([href, text], i) => [i ? "; " : "", h("a", { href }, text)]),
    " in lab.html beside this page; ./run lab makes it",
  );
}
