// SPDX-License-Identifier: Apache-2.0
// Types of a report's data and of a panel's input: the contract between C++, the page and its panels.

/** Any JSON value. */
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
// Results are untyped: panels read figures by name and omit missing ones.
export type Result = any;

/** A picture in the page; its words are base64 in <script type="text/plain" id=ID>. docs/report.md has the keys. */
export interface Picture {
  id: string;
  role: string;
  title: string;
  width: number;
  height: number;
  channels: number;
  codec: string;
  /** The word that stands for 1.0. */
  scale: number;
  /** null if the scale is not a power of two. */
  frac_bits: number | null;
  int_bits?: number | null;
  signed?: boolean;
  /** false: the file's values were rounded to words. */
  exact?: boolean;
  /** Made for display: sRGB, over black. */
  display?: boolean;
  sha256: string;
  from: string;
  /** Other files with the same values. */
  also?: string[];
  /** Kind of the file's samples: "raw words", "float"... */
  kind?: string;
  /** Pictures of one scene share a number. */
  group?: number;
  /** The picture whose block holds the words, if not its own. */
  same_as?: string;
  nonfinite?: number;
  /** Values are sRGB, as the colours of most trained Gaussians. */
  encoded?: boolean;
  /** Text below the picture. */
  note?: string;
  /** Set if it is a window of a larger picture. */
  crop?: { x: number; y: number; full_width: number; full_height: number };
  volume?: string;
  config?: string;
  config_hash?: string;
  /** The scene file's text. */
  scene?: string;
  /** The file of 3-D Gaussians. */
  gaussians?: string;
  /** Their view, as a link of the lab. */
  lab?: string;
  /** Its roles in compares: "0.ref" is the reference of results[0]. */
  compared?: string[];
}

/** <script type="application/json" id="data">. */
export interface PageData {
  program: string | Json;
  made: string[];
  verdict: { status: "pass" | "fail" | "error" | "none"; sentence: string; items?: { status: string; sentence: string }[] };
  results: Result[];
  pictures: Picture[];
  /** Pictures that are missing, cropped or omitted, and why. */
  remarks: string[];
}

/** One result and its place in PageData.results. */
export interface Item {
  index: number;
  result: Result;
}

export interface Context {
  /** Index of the result in PageData.results; first part of every data-figure. */
  index: number;
  page: PageData;
  /** The results drawn together, in order: one, or all of a panel with `once`. */
  items: Item[];
  pictures: Picture[];
  /** The base64 text of a picture's block; throws an Error that names it if it is missing. */
  block(id: string): string;
  /** Shows a message to the user, also through screen readers. */
  say(text: string): void;
}

export interface Panel {
  /** Short and stable: part of the section's id, `#compare-0`. */
  name: string;
  /** The subcommands whose results it draws; [] if it uses `wants`. */
  verbs: string[];
  /** Drawn once for all its results instead of once for each. */
  once?: boolean;
  /** Whether to draw the panel once, without a result: pictures. */
  wants?: (page: PageData) => boolean;
  title: string | ((result: Result, context: Context) => string);
  /** One sentence: what the panel shows, with uncommon units. */
  about: string | ((result: Result) => string);
  /** Its subject, if neither a scan nor a picture; by default subject.ts determines it. */
  of?: string;
  /** The page is ready when all returned promises have resolved. Throwing marks the page as failed, naming the
   *  panel. */
  render(root: HTMLElement, result: Result, context: Context): void | Promise<void>;
}

/** Subcommand of a result; coverage files are recognised by their format, older results of `compare` by their
 *  schema. */
export function verb_of(result: Result): string {
  if (typeof result?.verb === "string") return result.verb;
  if (typeof result?.format === "string" && result.format.startsWith("fastsplat coverage ")) return "coverage";
  const schema = typeof result?.schema === "string" ? /^fastsplat\.([a-z]+)\//.exec(result.schema) : null;
  return schema ? schema[1] : "";
}

/** Reads the page's data; throws an Error if they are missing or invalid. */
export function read_page(): PageData {
  const block = document.getElementById("data");
  if (!block) throw new Error("this page holds no data: it is the empty template");
  const data = JSON.parse(block.textContent ?? "") as Partial<PageData>;
  if (!Array.isArray(data.results)) throw new Error("the page's data has no list of results");
  return {
    program: data.program ?? "",
    made: data.made ?? [],
    verdict: data.verdict ?? { status: "none", sentence: "" },
    results: data.results,
    pictures: data.pictures ?? [],
    remarks: data.remarks ?? [],
  };
}

export function picture_block(id: string): string {
  const block = document.getElementById(id);
  if (!block) throw new Error(`picture ${id}: its block is not in the page`);
  return block.textContent ?? "";
}
