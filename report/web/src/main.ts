// SPDX-License-Identifier: Apache-2.0
// Draws the page: header, contents, and the panels of all results. html[data-ready] becomes "1" when everything is
// drawn and "error" if something failed; the error is shown in the page and in the console.
import { command_button, h, say } from "./dom";
import { picture_block, read_page, verb_of, type Context, type Item, type PageData, type Panel } from "./page";
import { panels } from "./registry";
import { differing, subject_line, subject_of, subject_of_pictures, subject_text, type Subject } from "./subject";
import { start_theme, theme_button } from "./theme";
import { generic } from "./panels/generic";
import "uplot/dist/uPlot.min.css";
import "./report.css";

interface Part {
  panel: Panel;
  items: Item[];
}

/** Assigns every result to exactly one panel; `generic` takes those that no other draws. */
function parts_of(page: PageData): Part[] {
  const items = page.results.map((result, index) => ({ index, result }));
  const taken = new Set<number>();
  const parts: Part[] = [];
  for (const panel of [...panels, generic]) {
    if (panel.wants?.(page)) parts.push({ panel, items: [] });
    const mine = items.filter((item) => !taken.has(item.index) && (panel === generic || panel.verbs.includes(verb_of(item.result))));
    mine.forEach((item) => taken.add(item.index));
    if (panel.once && mine.length) parts.push({ panel, items: mine });
    else if (!panel.once) for (const item of mine) parts.push({ panel, items: [item] });
  }
  return parts;
}

/** Subject of the verdict: that of the first result with this verdict; without results, of the pictures. */
function main_subject(page: PageData): Subject {
  const { status, sentence, items } = page.verdict;
  const first = items?.findIndex((item) => item.status === status && item.sentence === sentence) ?? -1;
  const result = page.results[Math.max(0, first)];
  return result ? subject_of([result]) : subject_of_pictures(page.pictures);
}

function header(page: PageData, subject: Subject): void {
  const { status, sentence } = page.verdict;
  const of = subject_text(subject);
  const words = { pass: "\u2713 Pass", fail: "\u2717 Fail", error: "\u2717 Error", none: "No verdict" };
  const program = typeof page.program === "string" ? page.program : JSON.stringify(page.program);
  document.title = [words[status] ?? status, of, "FastSplat report"].filter(Boolean).join(": ");
  document.getElementById("top")?.append(
    h("div", { class: "line" }, h("h1", {}, of ? `FastSplat report: ${of}` : "FastSplat report"), theme_button()),
    h("p", { class: "verdict" }, h("span", { class: `mark ${status}` }, words[status] ?? status), sentence),
    h("p", { class: "made" }, program),
  );
  const made = page.made.filter((command) => command !== "");
  document.getElementById("foot")?.append(
    h("p", {}, "One file: it needs no network and asks for nothing. Commands name files without their folders: run them where the files are."),
    ...(made.length
      ? [h("details", {}, h("summary", {}, "Commands that made this report"), h("pre", {}, made.join("\n"))), command_button(made.join("\n"), "the report")]
      : []),
  );
}

function broken(where: Element, what: string, error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  where.append(h("p", { class: "broken", role: "alert" }, `${what} could not be drawn: ${message}`));
  console.error(`${what}: ${message}`, error);
}

async function draw(page: PageData, of_all: Subject): Promise<boolean> {
  const main = document.getElementById("content") as HTMLElement;
  const links = h("ul");
  main.replaceChildren();
  document.getElementById("contents")?.append(links);
  let whole = true;
  const drawing: Promise<void>[] = [];
  const others = new Map<string, string[]>(); // panels whose subject differs from the verdict's, by the difference
  for (const part of parts_of(page)) {
    const { panel, items } = part;
    const first = items[0] ?? { index: -1, result: null };
    const context: Context = { index: first.index, page, items, pictures: page.pictures, block: picture_block, say };
    const id = first.index < 0 ? panel.name : `${panel.name}-${first.index}`;
    let title = panel.name;
    const section = h("section", { class: "panel", id, "data-panel": panel.name, "aria-labelledby": `${id}-title` });
    const body = h("div");
    let about = "";
    let of: Subject = { scans: [], configs: [], sizes: [] };
    try {
      title = typeof panel.title === "string" ? panel.title : panel.title(first.result, context);
      about = typeof panel.about === "string" ? panel.about : panel.about(first.result);
      of = items.length ? subject_of(items.map((item) => item.result)) : subject_of_pictures(page.pictures);
    } catch (error) {
      whole = false;
      broken(body, title, error);
    }
    const commands = items.map((item) => item.result?.command).filter((text) => typeof text === "string" && text);
    section.append(
      h("header", {}, h("h2", { id: `${id}-title` }, title, " ", h("span", { class: "of" }, panel.of ?? subject_line(of, of_all))), commands.length > 0 && command_button(commands.join("\n"), title)),
      h("p", { class: "note about" }, about),
      body,
    );
    main.append(section);
    const other = panel.of ? [] : differing(of, of_all);
    if (other.length) others.set(other.join(", "), [...(others.get(other.join(", ")) ?? []), title]);
    links.append(h("li", {}, h("a", { href: `#${id}` }, title)));
    drawing.push(
      (async () => panel.render(body, first.result, context))().catch((error) => {
        whole = false;
        broken(body, title, error);
      }),
    );
  }
  if (others.size)
    document.getElementById("top")?.append(
      h("p", { class: "note others" }, "These panels show other runs than the verdict's:", [...others].map(([what, titles]) => [h("br"), h("strong", {}, what), `: ${titles.join("; ")}`])),
    );
  if (!drawing.length) main.append(h("p", { class: "note" }, "There is no result in this report."));
  await Promise.all(drawing);
  return whole;
}

async function start(): Promise<void> {
  start_theme();
  let whole = false;
  try {
    const page = read_page();
    const subject = main_subject(page);
    header(page, subject);
    whole = await draw(page, subject);
  } catch (error) {
    broken(document.getElementById("content") as HTMLElement, "The report", error);
  }
  document.documentElement.dataset.ready = whole ? "1" : "error";
}

void start();
