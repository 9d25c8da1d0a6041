// SPDX-License-Identifier: Apache-2.0
// Coverage: the bins hit by the campaigns, group by group. For coverage files and those of a plan.
import { h } from "../dom";
import { number_text, path_text } from "../figures";
import { verb_of, type Context, type Panel, type Result } from "../page";
import { lead, note, tiles } from "../parts";
import { stacks } from "../bars";
import { legend } from "../svg";
import { table } from "../table";

/** A coverage book and its path in the result. */
interface Book {
  name: string;
  book: Result;
  path: (string | number)[];
}

/** Finds the books in a value: one book, a list, or books by configuration. */
export function books_of(value: Result, path: (string | number)[] = []): Book[] {
  if (!value || typeof value !== "object") return [];
  if (value.campaigns) return [{ name: value.config ?? "", book: value, path }];
  return Object.entries(value).flatMap(([key, each]) => books_of(each, [...path, Array.isArray(value) ? Number(key) : key]).map((one) => ({ ...one, name: one.name || key })));
}

interface Bin {
  name: string;
  group: string;
  hits: number;
  campaigns: string;
}

/** All bins with their hits over all campaigns, and the campaign with the most hits. */
function bins_of(book: Result, only: string): Bin[] {
  const bins = new Map<string, Bin & { most: number }>();
  for (const [campaign, hits] of Object.entries(book.campaigns as Record<string, Record<string, number>>)) {
    if (only && campaign !== only) continue;
    for (const [name, count] of Object.entries(hits)) {
      const bin = bins.get(name) ?? { name, group: name.split(".")[0], hits: 0, campaigns: "", most: 0 };
      bin.hits += count;
      if (count > bin.most) [bin.most, bin.campaigns] = [count, campaign];
      bins.set(name, bin);
    }
  }
  return [...bins.values()];
}

/** Draws each book in its own part of `root`. */
export function draw_books(root: HTMLElement, books: Book[], context: Context): void {
  for (const { name, book, path } of books) {
    if (books.length > 1) root.append(h("h3", {}, `Configuration ${name}`));
    const place = h("div");
    const campaigns = Object.keys(book.campaigns);
    const choice = h("select", { change: () => draw() }, h("option", { value: "" }, "all campaigns"), campaigns.map((each) => h("option", { value: each }, each)));
    const show = (key: string): HTMLElement => h("span", { class: "figure", "data-figure": path_text(context.index, [...path, key]) }, number_text(book[key]));
    root.append(
      tiles(["Streams", show("streams")], ["Splats", show("splats")], ["Comparisons", show("comparisons")], ["Cycles", show("cycles")], ["Campaigns", number_text(campaigns.length)]),
      h("div", { class: "controls" }, h("label", {}, "Campaign ", choice)),
      place,
    );
    const draw = (): void => {
      const bins = bins_of(book, choice.value);
      const groups = new Map<string, { hit: number; all: number }>();
      for (const bin of bins) {
        const group = groups.get(bin.group) ?? { hit: 0, all: 0 };
        groups.set(bin.group, { hit: group.hit + (bin.hits > 0 ? 1 : 0), all: group.all + 1 });
      }
      const open = bins.filter((bin) => bin.hits === 0);
      const hit = bins.length - open.length;
      place.replaceChildren();
      place.append(
        h("p", {}, h("strong", { "data-coverage": `${hit}/${bins.length}` }, `${number_text(hit)} of ${number_text(bins.length)}`), ` bins are hit, ${number_text((100 * hit) / Math.max(1, bins.length), { digits: 1 })} %.`),
      );
      stacks(
        place,
        { title: "Bins by group", label: [...groups].map(([group, { hit: n, all }]) => `${group} ${n} of ${all}`).join(", "), unit: "% of the group's bins", most: 100, dense: true },
        [...groups].map(([group, { hit: n, all }]) => ({
          name: group,
          shown: `${n} / ${all}`,
          parts: [
            { name: "hit", value: (100 * n) / all, colour: "c0", tip: `${group}: ${n} of ${all} bins hit` },
            { name: "open", value: (100 * (all - n)) / all, colour: "quiet", tip: `${group}: ${all - n} of ${all} bins open` },
          ],
        })),
      );
      place.append(legend([{ name: "hit", colour: "c0" }, { name: "not hit", colour: "quiet" }]));
      table(place, {
        label: `Bins of ${name}`,
        filter: true,
        rows: [...open, ...bins.filter((bin) => bin.hits > 0)],
        columns: [
          { name: "Bin", value: (bin) => bin.name },
          { name: "Hits", value: (bin) => bin.hits, kind: (bin) => (bin.hits === 0 ? "fail" : "") },
          { name: "State", value: (bin) => (bin.hits ? "\u2713 hit" : "\u2717 not hit"), kind: (bin) => (bin.hits ? "pass" : "fail") },
          { name: "Most by", value: (bin) => bin.campaigns },
        ],
      });
    };
    draw();
  }
}

export const coverage: Panel = {
  name: "coverage",
  verbs: ["coverage"],
  title: (result) => `Coverage of ${result.config ?? "the device"}`,
  about: "Which coverage bins the test streams hit, and how often.",
  render(root, result, context) {
    const books = books_of(result);
    if (!books.length) throw new Error(`${verb_of(result)}: there is no campaign in it`);
    const bins = books.flatMap(({ book }) => bins_of(book, ""));
    const open = bins.filter((bin) => bin.hits === 0).length;
    root.append(
      lead(null, open === 0 ? `All ${number_text(bins.length)} bins are hit.` : `${number_text(open)} of ${number_text(bins.length)} bins are not hit yet.`),
      note(result.config ? `Configuration ${result.config} ${result.config_hash ?? ""}` : ""),
    );
    draw_books(root, books, context);
  },
};
