// SPDX-License-Identifier: Apache-2.0
// Files from the user's disk: dropped or chosen. Sorts them by kind; a file too large is refused before it is read.
import { h } from "../../../report/web/src/dom";

export interface Taken {
  /** A volume, with the files that its header names, or Gaussians; the first is the one to show. */
  volumes: { name: string; blob: Blob }[];
  /** Whether the first file holds 3-D Gaussians. */
  gaussians: boolean;
  tf: string | null;
  config: string | null;
}

/** A name that is safe as a path and in a link. */
function safe(name: string): string {
  return name.replace(/[^A-Za-z0-9._-]/g, "_").replace(/^\.+/, "_") || "volume";
}

const is_text = /\.toml$/i;
/** Raw data that a header in another file names. */
const is_data = /\.(raw|zraw|img|bin)$/i;
/** The engine reads all of them but `.sog`, which it names. */
const is_gaussians = /\.(ply|splat|spz|glb|ksplat|sog)$/i;
const is_volume = /\.(nii|nrrd|nhdr|mha|mhd|hdr|raw|zraw|img|bin|gz)$/i;

/** Reads dropped files. Throws an Error with one line about the first that cannot be used. */
export async function taken(files: File[], most_bytes: number): Promise<Taken> {
  const result: Taken = { volumes: [], gaussians: false, tf: null, config: null };
  for (const file of files) {
    const mb = (bytes: number): string => `${Math.round(bytes / 1e6)} MB`;
    if (file.size > most_bytes) throw new Error(`${file.name}: too large for a page: at most ${mb(most_bytes)}, got ${mb(file.size)}; use the program`);
    if (file.size === 0) throw new Error(`${file.name}: the file is empty`);
    if (is_text.test(file.name)) {
      if (file.size > 1_000_000) throw new Error(`${file.name}: too large for a configuration or transfer function`);
      const text = await file.text();
      if (/^\s*points\s*=/m.test(text) || /^\s*\[\[points\]\]/m.test(text)) result.tf = text;
      else result.config = text;
    } else if (is_volume.test(file.name) || is_gaussians.test(file.name)) {
      result.volumes.push({ name: safe(file.name), blob: file });
    } else {
      throw new Error(`${file.name}: not a volume (.nii, .nrrd, .mha, .mhd, also .gz), 3-D Gaussians (.ply, .splat, .spz, .glb, .ksplat) or a .toml file`);
    }
  }
  result.volumes.sort((a, b) => Number(is_data.test(a.name)) - Number(is_data.test(b.name)));
  result.gaussians = is_gaussians.test(result.volumes[0]?.name ?? "");
  return result;
}

/** Saves a text as a file of the user. */
export function save(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Takes files dropped anywhere on the page. Returns a function that lets the user choose files. */
export function listen_for_files(take: (files: File[]) => void): () => void {
  const input = h("input", { type: "file", multiple: true, id: "file", class: "off", tabindex: -1, "aria-label": "Files", change: () => (take([...(input.files ?? [])]), (input.value = "")) });
  document.getElementById("foot")?.append(input);
  const files = (event: DragEvent): boolean => [...(event.dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragover", (event) => {
    if (!files(event)) return;
    event.preventDefault();
    document.body.classList.add("dropping");
  });
  addEventListener("dragleave", (event) => event.relatedTarget === null && document.body.classList.remove("dropping"));
  addEventListener("drop", (event) => {
    document.body.classList.remove("dropping");
    if (!files(event)) return;
    event.preventDefault();
    take([...(event.dataTransfer?.files ?? [])]);
  });
  return () => input.click();
}
