// SPDX-License-Identifier: Apache-2.0
// A table that sorts and filters and stays fast with thousands of rows: only visible rows are in the page. Printing
// inserts all rows.
import { h, type Child } from "./dom";
import { at, number_text, type Style } from "./figures";
import type { Result } from "./page";

export interface Column<Row> {
  name: string;
  unit?: string;
  /** Value for sorting and filtering; null sorts last. */
  value: (row: Row) => string | number | boolean | null | undefined;
  /** What is shown; default: the value, a number in `style`. */
  cell?: (row: Row) => Child;
  style?: Style;
  /** Path of the shown number in the JSON, for data-figure; undefined if there is none. */
  figure?: (row: Row) => string | undefined;
  /** Class of the cell: "pass", "fail", "wrap". */
  kind?: (row: Row) => string;
}

/** Columns of numbers in the rows of a list: numbers_of("0.sites", sites)("Mean", "lost.mean_ulp", "ulp"). */
export function numbers_of(list: string, rows: Result[]): (name: string, path: string, unit?: string, style?: Style) => Column<Result> {
  return (name, path, unit, style) => ({ name, unit, style, value: (row) => at(row, path.split(".")), figure: (row) => `${list}.${rows.indexOf(row)}.${path}` });
}

export interface TableOptions<Row> {
  label: string;
  columns: Column<Row>[];
  rows: Row[];
  filter?: boolean;
  /** Initial sort column, counted from 1; negative: largest first. */
  sort?: number;
  chosen?: (row: Row) => boolean;
  choose?: (row: Row) => void;
  /** Called with the filtered rows, in table order. */
  changed?: (rows: Row[]) => void;
}

export interface Table<Row> {
  root: HTMLElement;
  /** Redraws the rows after a change of the selection. */
  refresh(): void;
  /** Additional row filter; null accepts all. */
  only(accept: ((row: Row) => boolean) | null): void;
  /** Scrolls to the row. */
  reveal(row: Row): void;
}

const row_height = 31;
const whole_up_to = 120; // rows: shorter tables are in the page completely
const margin = 12; // rows drawn beyond the edges

/** Draws the rows of each table in the page; tables that were removed are forgotten. */
const drawn = new WeakMap<Element, (all: boolean) => void>();
const draw_all = (all: boolean): void => document.querySelectorAll(".table").forEach((root) => drawn.get(root)?.(all));
addEventListener("beforeprint", () => draw_all(true));
addEventListener("afterprint", () => draw_all(false));

type Test = (value: (name: string) => unknown, all: string) => boolean;

/** Parses "kind=circle psnr>60 head": every word must match; a word without a comparison may occur anywhere in the
 *  row. */
export function filter_of(text: string, names: string[]): Test {
  const tests = (text.match(/"[^"]*"|\S+/g) ?? []).map((word): Test => {
    const parts = /^"?([^<>=!"]+?)"?\s*(<=|>=|!=|<|>|=)\s*"?([^"]*)"?$/.exec(word);
    const name = parts && names.find((each) => each.toLowerCase() === parts[1].toLowerCase());
    if (!parts || !name) {
      const wanted = word.replaceAll('"', "").toLowerCase();
      return (_value, all) => all.includes(wanted);
    }
    const [, , sign, wanted] = parts;
    const number = Number(wanted);
    return (value) => {
      const got = value(name);
      if (sign === "=" || sign === "!=") {
        const same = typeof got === "number" && wanted !== "" && !Number.isNaN(number) ? got === number : String(got ?? "").toLowerCase() === wanted.toLowerCase();
        return same === (sign === "=");
      }
      if (typeof got !== "number" || Number.isNaN(number) || wanted === "") return false;
      return sign === "<" ? got < number : sign === ">" ? got > number : sign === "<=" ? got <= number : got >= number;
    };
  });
  return (value, all) => tests.every((test) => test(value, all));
}

function compare(a: unknown, b: unknown): number {
  const missing = (value: unknown): boolean => value === null || value === undefined || (typeof value === "number" && Number.isNaN(value));
  if (missing(a) || missing(b)) return Number(missing(a)) - Number(missing(b));
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

export function table<Row>(parent: HTMLElement, options: TableOptions<Row>): Table<Row> {
  const { rows } = options;
  // Omits columns that are empty in all rows.
  const has = (column: Column<Row>, row: Row): boolean => {
    const value = column.cell ? column.cell(row) : column.value(row);
    return value !== null && value !== undefined && value !== "" && value !== false && !Number.isNaN(value);
  };
  const columns = options.columns.filter((column) => !rows.length || rows.some((row) => has(column, row)));
  const names = columns.map((column) => column.name);
  const is_number = columns.map((column) => rows.some((row) => typeof column.value(row) === "number"));
  let sorted = options.sort ? columns.indexOf(options.columns[Math.abs(options.sort) - 1]) : -1;
  let upwards = (options.sort ?? 1) > 0;
  let words = "";
  let accept: ((row: Row) => boolean) | null = null;
  let shown = rows;
  let focus = 0; // index in `shown` of the row with the Tab stop

  const body = h("tbody");
  const heads = columns.map((column, i) => {
    const arrow = h("span", { class: "arrow", "aria-hidden": "true" });
    const button = h("button", { type: "button", click: () => sort(i) }, column.name, column.unit ? h("span", { class: "unit" }, column.unit) : null, arrow);
    return h("th", { scope: "col", class: is_number[i] ? "num" : null, "aria-sort": "none" }, button);
  });
  const scroll = h(
    "div",
    { class: "scroll", tabindex: 0, role: "group", "aria-label": options.label },
    h("table", { "aria-label": options.label, "aria-rowcount": rows.length + 1 }, h("thead", {}, h("tr", {}, heads)), body),
  );
  const count = h("span", { class: "note" });
  const input = h("input", {
    type: "search",
    size: 34,
    placeholder: example(),
    "aria-label": `Filter ${options.label}: words, or name<number`,
    input: () => {
      words = input.value;
      arrange();
    },
  });
  const long = rows.length > whole_up_to;
  const root = h(
    "div",
    { class: long ? "table long" : "table" },
    options.filter ? h("div", { class: "controls" }, h("label", {}, "Filter", input), count) : null,
    scroll,
  );
  parent.append(root);

  function example(): string {
    const number = is_number.indexOf(true);
    return number < 0 ? "words" : `words, or ${names[number].includes(" ") ? `"${names[number]}"` : names[number]}<1`;
  }

  function sort(column: number): void {
    upwards = sorted === column ? !upwards : true;
    sorted = column;
    arrange();
  }

  function arrange(): void {
    const test = filter_of(words, names);
    const text = (row: Row): string => columns.map((column) => String(column.value(row) ?? "")).join(" ").toLowerCase();
    shown = rows.filter((row) => (!accept || accept(row)) && (words.trim() === "" || test((name) => columns[names.indexOf(name)].value(row), text(row))));
    if (sorted >= 0) {
      const value = columns[sorted].value;
      const order = upwards ? 1 : -1;
      shown = shown
        .map((row, i) => ({ row, i, key: value(row) }))
        .sort((a, b) => {
          const missing = compare(a.key ?? null, b.key ?? null);
          const one_missing = a.key === null || a.key === undefined || b.key === null || b.key === undefined;
          return (one_missing ? missing : order * missing) || a.i - b.i;
        })
        .map(({ row }) => row);
    }
    heads.forEach((head, i) => {
      head.setAttribute("aria-sort", i !== sorted ? "none" : upwards ? "ascending" : "descending");
      (head.querySelector(".arrow") as HTMLElement).textContent = i !== sorted ? "" : upwards ? "\u25b2" : "\u25bc";
    });
    count.textContent = shown.length === rows.length ? `${number_text(rows.length)} rows` : `${number_text(shown.length)} of ${number_text(rows.length)} rows`;
    focus = 0;
    scroll.scrollTop = 0;
    draw();
    options.changed?.(shown);
  }

  function row_element(row: Row, place: number): HTMLElement {
    const element = h(
      "tr",
      {
        "aria-rowindex": place + 2,
        "aria-selected": options.choose ? String(options.chosen?.(row) ?? false) : null,
        tabindex: options.choose ? (place === focus ? 0 : -1) : null,
      },
      columns.map((column, i) => {
        const value = column.value(row);
        const text = typeof value === "number" ? number_text(value, column.style) : value === null || value === undefined ? "\u2013" : String(value);
        return h(
          "td",
          {
            class: [is_number[i] ? "num" : "", column.kind?.(row) ?? ""].join(" ").trim() || null,
            "data-figure": column.figure?.(row),
            "data-scale": column.figure ? column.style?.scale : null,
          },
          column.cell ? column.cell(row) : text,
        );
      }),
    );
    if (!options.choose) return element;
    element.addEventListener("click", () => {
      focus = place;
      options.choose?.(row);
    });
    element.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") options.choose?.(row);
      else if (event.key === "ArrowDown" || event.key === "ArrowUp") go(place + (event.key === "ArrowDown" ? 1 : -1));
      else return;
      event.preventDefault();
    });
    return element;
  }

  function go(place: number): void {
    if (place < 0 || place >= shown.length) return;
    focus = place;
    const top = place * row_height;
    if (long && top < scroll.scrollTop) scroll.scrollTop = top;
    else if (long && top > scroll.scrollTop + scroll.clientHeight - 3 * row_height) scroll.scrollTop = top - scroll.clientHeight + 3 * row_height;
    draw();
    body.querySelector<HTMLElement>(`tr[aria-rowindex="${place + 2}"]`)?.focus({ preventScroll: long });
  }

  function spacer(height: number): HTMLElement {
    return h("tr", { "aria-hidden": "true" }, h("td", { colspan: columns.length, style: `height:${height}px;padding:0;border:0` }));
  }

  function draw(all = false): void {
    const windowed = !all && shown.length > whole_up_to;
    const first = windowed ? Math.max(0, Math.floor(scroll.scrollTop / row_height) - margin) : 0;
    const last = windowed ? Math.min(shown.length, Math.ceil((scroll.scrollTop + Math.max(scroll.clientHeight, 480)) / row_height) + margin) : shown.length;
    const visible = shown.slice(first, last).map((row, i) => row_element(row, first + i));
    if (!shown.length) visible.push(h("tr", {}, h("td", { colspan: columns.length }, "No row is left: change the filter.")));
    body.replaceChildren(...(first > 0 ? [spacer(first * row_height)] : []), ...visible, ...(last < shown.length ? [spacer((shown.length - last) * row_height)] : []));
  }

  let waiting = 0;
  scroll.addEventListener("scroll", () => {
    if (!long || waiting) return;
    waiting = requestAnimationFrame(() => {
      waiting = 0;
      draw();
    });
  });
  drawn.set(root, draw);
  arrange();
  return {
    root,
    refresh: () => draw(),
    only: (test) => {
      accept = test;
      arrange();
    },
    reveal: (row) => {
      const place = shown.indexOf(row);
      if (place < 0) return;
      focus = place;
      if (long) scroll.scrollTop = Math.max(0, place * row_height - scroll.clientHeight / 2);
      draw();
    },
  };
}
