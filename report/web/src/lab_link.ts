// SPDX-License-Identifier: Apache-2.0
// Links to the lab's page, lab.html beside the report: the scenes and configurations of the report's pictures.
import { h } from "./dom";
import type { Picture } from "./page";
import { subject_of_pictures, subject_text } from "./subject";

/** The lab reads the scene's file and says if its configuration of that name has another hash. */
function address({ scene = "", config, config_hash = "" }: Picture): string {
  return `lab.html#lab?${String(new URLSearchParams({ scene, ...(config ? { config, config_hash } : {}) }))}`;
}

/** A line with the links; null if no picture has a scene. */
export function lab_links(pictures: Picture[]): HTMLElement | null {
  const scenes = pictures.filter((picture) => picture.scene);
  // A golden picture shares its link with the device's of the same scene.
  const devices = scenes.filter((one) => one.config || !scenes.some((other) => other.config && other.scene === one.scene));
  const links = new Map(devices.map((picture) => [address(picture), subject_text(subject_of_pictures([picture]))]));
  if (links.size === 0) return null;
  return h(
    "p",
    { class: "note", id: "open-in-lab" },
    "Open in the lab: ",
    [...links].flatMap(([href, text], i) => [i ? "; " : "", h("a", { href }, text)]),
    ". The page lab.html must lie beside this report; ./run lab makes it.",
  );
}
