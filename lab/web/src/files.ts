// SPDX-License-Identifier: Apache-2.0
// Files from the user's disk: dropped or chosen. Sorts them by kind; a file too large is refused before it is read.
import { h } from "../../../report/web/src/dom";

/** A header names others of the drop, its data. */
type Kind = "header" | "volume" | "gaussians" | "data";

export interface Taken {
  /** The first is the one to show. */
  volumes: { name: string; blob: Blob; kind: Kind }[];
  tf: string | null;
  config: string | null;
}

/** A name that is safe as a path. */
function safe(name: string): string {
  return name.replace(/[/\\\p{Cc}]/gu, "_").replace(/^\.+/, "_") || "volume";
}

const is_text = /\.toml$/i;
/** Raw data that a header in another file names. */
const is_data = /\.(raw|zraw|img|bin)$/i;
const is_header = /\.(nhdr|mhd|hdr)$/i;
/** The engine reads all of them but `.sog`, which it names. */
const is_gaussians = /\.(ply|splat|spz|glb|ksplat|sog)$/i;
const is_volume = /\.(nii|nrrd|mha|gz)$/i;
const order: Kind[] = ["header", "volume", "gaussians", "data"];

/** Reads dropped files. Throws an Error with one line about the first that cannot be used. */
export async function taken(files: File[], most_bytes: number): Promise<Taken> {
  const result: Taken = { volumes: [], tf: null, config: null };
  // Data may have any name.
  const with_header = files.some((file) => is_header.test(file.name));
  for (const file of files) {
    const mb = (bytes: number): string => `${Math.round(bytes / 1e6)} MB`;
    if (file.size > most_bytes) throw new Error(`${file.name}: too large for a page: at most ${mb(most_bytes)}, got ${mb(file.size)}; use the program`);
    if (file.size === 0) throw new Error(`${file.name}: the file is empty`);
    if (is_text.test(file.name)) {
      if (file.size > 1_000_000) throw new Error(`${file.name}: too large for a configuration or transfer function`);
      const text = await file.text();
      if (/^\s*points\s*=/m.test(text) || /^\s*\[\[points\]\]/m.test(text)) result.tf = text;
      else result.config = text;
    } else {
      const kind: Kind | null = is_header.test(file.name) ? "header" : is_gaussians.test(file.name) ? "gaussians" : with_header || is_data.test(file.name) ? "data" : is_volume.test(file.name) ? "volume" : null;
      if (kind) result.volumes.push({ name: safe(file.name), blob: file, kind });
      else throw new Error(`${file.name}: not a volume (.nii, .nrrd, .mha, .mhd, also .gz), 3-D Gaussians (.ply, .splat, .spz, .glb, .ksplat) or a .toml file`);
    }
  }
  result.volumes.sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind));
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
