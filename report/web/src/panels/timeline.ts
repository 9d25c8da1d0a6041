// SPDX-License-Identifier: Apache-2.0
// The timeline of `cycles --timeline`: when each sheet and tile passed through the device.
import { columns } from "../bars";
import { h, s } from "../dom";
import { number_text } from "../figures";
import type { Context, Result } from "../page";
import { linear } from "../scales";
import { axis_below, drawing, legend, rectangle, text } from "../svg";
import { table } from "../table";

type Row = Record<string, number>;

function rows_of(names: string[], rows: number[][]): Row[] {
  return rows.map((row) => Object.fromEntries(names.map((name, i) => [name, row[i]])));
}

interface Slice {
  from: number;
  to: number;
  name: string;
  odd: boolean;
}

/** Merges slices thinner than a pixel, so that thousands of sheets draw quickly. */
function merged(slices: Slice[], per_pixel: number): Slice[] {
  const out: Slice[] = [];
  let count = 1;
  for (const slice of slices) {
    const last = out[out.length - 1];
    if (last && slice.to - slice.from < per_pixel && slice.from - last.to < per_pixel / 2 && last.to - last.from < 3 * per_pixel) {
      last.to = slice.to;
      last.name = `${++count} sheets to ${slice.name}`;
    } else {
      count = 1;
      out.push({ ...slice });
    }
  }
  return out;
}

export function timeline(root: HTMLElement, result: Result, context: Context): void {
  const lists = result.timeline;
  const sheets = rows_of(lists.sheet_columns, lists.sheets);
  const all_tiles = rows_of(lists.tile_columns, lists.tiles);
  root.append(h("h3", {}, "Timeline by tile and sheet"));
  const place = h("div");
  const choice = h(
    "select",
    { change: () => draw() },
    h("option", { value: "" }, "all"),
    all_tiles.map((tile) => h("option", { value: tile.tile }, `tile ${tile.tile}`)),
  );
  if (all_tiles.length > 1) root.append(h("div", { class: "controls" }, h("label", {}, "Show ", choice)));
  root.append(place);

  function draw(): void {
    const chosen = choice.value === "" ? null : Number(choice.value);
    const mine = chosen === null ? sheets : sheets.filter((sheet) => sheet.tile === chosen);
    const tiles = chosen === null ? all_tiles : all_tiles.filter((tile) => tile.tile === chosen);
    place.replaceChildren();
    if (!mine.length) return;
    const low = chosen === null ? 0 : Math.min(...tiles.map((tile) => tile.begun));
    const high = Math.max(...mine.map((sheet) => sheet.walk_to), ...tiles.map((tile) => tile.picture_to));
    const name = (sheet: Row): string => `tile ${sheet.tile}, sheet ${sheet.sheet}`;
    const tracks: { name: string; colour: string; slices: Slice[] }[] = [
      { name: "waits", colour: "c3", slices: mine.filter((sheet) => sheet.begun > sheet.offered).map((sheet, i) => ({ from: sheet.offered, to: sheet.begun, name: `${name(sheet)} waits for a buffer`, odd: i % 2 > 0 })) },
      { name: "splats", colour: "c0", slices: mine.map((sheet, i) => ({ from: sheet.begun, to: sheet.closed + 1, name: `${name(sheet)}: ${number_text(sheet.windows)} windows`, odd: i % 2 > 0 })) },
      { name: "compositor", colour: "c2", slices: mine.filter((sheet) => sheet.walk_to > sheet.walk_from).map((sheet, i) => ({ from: sheet.walk_from, to: sheet.walk_to, name: `${name(sheet)}: ${number_text(sheet.blocks)} blocks`, odd: i % 2 > 0 })) },
      { name: "pixels out", colour: "c4", slices: tiles.map((tile, i) => ({ from: tile.picture_from, to: tile.picture_to, name: `picture of tile ${tile.tile}`, odd: i % 2 > 0 })) },
    ];
    drawing(
      place,
      {
        title: chosen === null ? "All tiles" : `Tile ${chosen}`,
        about: "which unit works on which sheet, over cycles",
        label: `Timeline of ${mine.length} sheets in ${tiles.length} tiles over ${high - low} cycles`,
      },
      (to) => {
        const left = 84;
        const row = 30;
        const bottom = tracks.length * row + 18;
        to.height(bottom + 34);
        const scale = linear(low, high, left, to.width - 6, to.width > 700 ? 8 : 3);
        axis_below(to, scale, 0, bottom, "cycle");
        // Where tiles begin.
        let free = -99;
        for (const tile of tiles) {
          const x = scale(tile.begun);
          to.svg.append(s("line", { x1: x, x2: x, y1: 4, y2: bottom, class: "axis" }));
          const label = `tile ${tile.tile}`;
          if (x < free || x + label.length * 7 > to.width) continue;
          to.svg.append(text(x + 3, 12, label, { class: "tick" }));
          free = x + label.length * 7 + 8;
        }
        tracks.forEach((track, i) => {
          const y = 18 + i * row;
          to.svg.append(text(left - 8, y + row / 2 + 4, track.name, { "text-anchor": "end" }));
          for (const slice of merged(track.slices, (high - low) / (to.width - left))) {
            const [a, b] = [scale(slice.from), scale(slice.to)];
            const bar = rectangle(a, y + 4, Math.max(0.7, b - a), row - 8, track.colour, { "fill-opacity": slice.odd ? 0.65 : 1 });
            to.svg.append(bar);
            to.tip(bar, `${slice.name}, cycles ${number_text(slice.from)} to ${number_text(slice.to)}`);
          }
        });
      },
    );
    place.append(
      legend([
        { name: "begin_sheet waits for a buffer", colour: "c3" },
        { name: "splats of a sheet go in", colour: "c0" },
        { name: "the compositor walks its blocks", colour: "c2" },
        { name: "pixels go out", colour: "c4" },
      ]),
    );
    if (chosen === null && all_tiles.length > 1)
      columns(
        place,
        {
          title: "Cycles of each tile",
          about: "from its first record to its last pixel",
          label: `Cycles of ${all_tiles.length} tiles`,
          unit: "cycles",
          x_name: "tile",
          height: 170,
        },
        all_tiles.map((tile) => ({ name: String(tile.tile), value: tile.picture_to - tile.begun, tip: `tile ${tile.tile}: ${number_text(tile.picture_to - tile.begun)} cycles, from ${number_text(tile.begun)}` })),
      );
    const at = (name: string) => (sheet: Row) => `${context.index}.timeline.sheets.${sheets.indexOf(sheet)}.${lists.sheet_columns.indexOf(name)}`;
    table(place, {
      label: "Sheets",
      filter: true,
      rows: mine,
      columns: [
        { name: "Tile", value: (sheet) => sheet.tile, figure: at("tile") },
        { name: "Sheet", value: (sheet) => sheet.sheet, figure: at("sheet") },
        { name: "Begun", value: (sheet) => sheet.begun, figure: at("begun") },
        { name: "Cycles", value: (sheet) => sheet.closed + 1 - sheet.begun },
        { name: "Windows", value: (sheet) => sheet.windows, figure: at("windows") },
        { name: "Waited", value: (sheet) => sheet.begun - sheet.offered },
        { name: "Dirty blocks", value: (sheet) => sheet.blocks, figure: at("blocks") },
        { name: "Composited until", value: (sheet) => sheet.walk_to, figure: at("walk_to") },
      ],
    });
    const left_out = lists.sheets_left_out + lists.tiles_left_out;
    if (left_out > 0) place.append(h("p", { class: "note" }, `${number_text(left_out)} later sheets and tiles are not in the result.`));
  }
  draw();
}
