// What a report holds and what a panel is given: the contract between C++, the page and its panels.

/** Any JSON value. */
export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
// A verb's result is drawn as it is: panels read it by name, and what is missing is left out.
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type Result = any;

/** A picture in the page: its words lie as base64 in <script type="text/plain" id=ID>; docs/report.md has the keys. */
export interface Picture {
  id: string;
  role: string;
  title: string;
  width: number;
  height: number;
  channels: number;
  codec: string;
  /** The word of 1.0. */
  scale: number;
  /** null where the scale is no power of two. */
  frac_bits: number | null;
  int_bits?: number | null;
  signed?: boolean;
  /** false: the file's values were rounded to words. */
  exact?: boolean;
  /** Made for looking: sRGB, over black. */
  display?: boolean;
  sha256: string;
  from: string;
  /** Other files with the same values. */
  also?: string[];
  /** Of the file's samples: "raw words", "float"... */
  kind?: string;
  /** Pictures of one scene have one number. */
  group?: number;
  /** The picture whose block holds the words, where that is another. */
  same_as?: string;
  nonfinite?: number;
  /** It is a window of a larger picture. */
  crop?: { x: number; y: number; full_width: number; full_height: number };
  volume?: string;
  config?: string;
  /** The scene file's text. */
  scene?: string;
  /** Where 3-D Gaussians come from. */
  gaussians?: string;
  /** Of which compares it is what: "0.ref" is the reference of results[0]. */
  compared?: string[];
}

/** <script type="application/json" id="data">. */
export interface PageData {
  program: string | Json;
  made: string[];
  verdict: { status: "pass" | "fail" | "error" | "none"; sentence: string; items?: { status: string; sentence: string }[] };
  results: Result[];
  pictures: Picture[];
  /** Pictures that are missing, cropped or left out, and why. */
  remarks: string[];
}

/** One result and its place in PageData.results. */
export interface Item {
  index: number;
  result: Result;
}

export interface Context {
  /** Place of the result among all; first part of every data-figure. */
  index: number;
  page: PageData;
  /** All results of this panel, in order; of a panel with `once` all that it draws. */
  items: Item[];
  pictures: Picture[];
  /** The base64 text of a picture's block; throws, and names it, when it is not there. */
  block(id: string): string;
  /** Says something to the user and to a screen reader. */
  say(text: string): void;
}

export interface Panel {
  /** Short and stable: part of the section's id, `#compare-0`. */
  name: string;
  /** The verbs it draws; [] of a panel that `wants` something else. */
  verbs: string[];
  /** Drawn once for all its results, instead of once for each. */
  once?: boolean;
  /** Drawn once, without a result, when this says so: pictures. */
  wants?: (page: PageData) => boolean;
  title: string | ((result: Result, context: Context) => string);
  /** One sentence: what the panel shows, and its units that are no common ones. */
  about: string | ((result: Result) => string);
  /** Of what it is, where that is neither scan nor picture; without it as subject.ts finds. */
  of?: string;
  /** May return a promise: the page is ready when all have come. Throwing fails the page, by name. */
  render(root: HTMLElement, result: Result, context: Context): void | Promise<void>;
}

/** Verb of a result; a coverage book names its format, older results of `compare` their schema. */
export function verb_of(result: Result): string {
  if (typeof result?.verb === "string") return result.verb;
  if (typeof result?.format === "string" && result.format.startsWith("fastsplat coverage ")) return "coverage";
  const schema = typeof result?.schema === "string" ? /^fastsplat\.([a-z]+)\//.exec(result.schema) : null;
  return schema ? schema[1] : "";
}

/** The page's data, or an Error that says what is wrong with it. */
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
