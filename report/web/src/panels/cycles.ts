// SPDX-License-Identifier: Apache-2.0
// `cycles`: how many cycles the device takes and how they are spent.
import { columns, stacks, waterfall } from "../bars";
import { line_legend, plot, type Line } from "../charts";
import { h } from "../dom";
import { figures_of, number_text, path_text } from "../figures";
import type { Context, Panel, Result } from "../page";
import { cell, grid, lead, made_of, note, tiles } from "../parts";
import { legend } from "../svg";
import { table } from "../table";
import { timeline } from "./timeline";

const causes: Record<string, string> = {
  ideal: "windows and dirty blocks, one a cycle",
  records: "records that are no splat, one cycle each",
  table_load: "table words, one cycle each",
  hidden: "hidden splats that were sent, and rows of hidden windows, one cycle each",
  input: "no record: the source was late",
  sheet_buffer: "begin_sheet waits for a buffer",
  map: "begin_sheet waits for the map of opaque cells",
  drain: "end_tile waits for the pipes",
  hazard: "a window waits for the one before, which it lies over",
  pixels: "the picture goes out",
  output: "a pixel beat waits: the sink was not ready",
};
const shares: [name: string, colour: string, meaning: string][] = [
  ["work", "c0", "windows, and dirty blocks that none hides"],
  ["fill", "c5", "wipe, tables, records, pipes"],
  ["bandwidth", "c1", "no beat: the link, or the input, was late"],
  ["pixel_out", "c2", "the picture goes out"],
  ["tail", "c3", "no tile is left for a device while others work"],
];
const bounds: [name: string, colour: string, meaning: string][] = [
  ["lanes", "c0", "windows / devices"],
  ["compositor", "c2", "dirty blocks / devices"],
  ["stream", "c1", "bytes in / bytes a cycle"],
  ["pixel_out", "c4", "pixel beats / devices"],
];
const plain = (name: string): string => name.replaceAll("_", " ");

function account(root: HTMLElement, result: Result): void {
  const parts = Object.entries(result.cycles.account as Record<string, number>);
  const ideal = result.cycles.account.ideal as number;
  const lost = parts.reduce((sum, [name, cycles]) => sum + (name === "ideal" ? 0 : cycles), 0);
  // If the losses are small, the axis begins shortly below the ideal, so that they are visible.
  const from = ideal > 0 && lost < ideal * 0.25 ? Math.max(0, ideal - Math.max(lost, 1) * 0.25) : undefined;
  waterfall(
    root,
    {
      title: "Ideal + losses = actual",
      about: from ? `cycles; the axis begins at ${number_text(Math.round(from))}` : "cycles",
      label: `Waterfall of cycles: ${parts.map(([name, cycles]) => `${plain(name)} ${cycles}`).join(", ")}, actual ${result.cycles.actual}`,
      unit: "cycles",
      from,
    },
    [
      ...parts.map(([name, cycles]) => ({
        name: plain(name),
        value: cycles,
        shown: number_text(cycles),
        tip: `${plain(name)}: ${number_text(cycles)} cycles, ${number_text((100 * cycles) / (ideal || 1), { digits: 3 })} % of the ideal; ${causes[name] ?? ""}`,
        total: name === "ideal",
        colour: name === "ideal" ? "c0" : "c3",
      })),
      { name: "actual", value: result.cycles.actual, shown: number_text(result.cycles.actual), tip: `actual: ${number_text(result.cycles.actual)} cycles in which the device was busy`, total: true },
    ],
  );
}

function roofline(root: HTMLElement, rows: Result[]): void {
  const lines: Line[] = [
    ...bounds.map(([name, colour, meaning], i) => ({
      name: `${plain(name)}: ${meaning}`,
      colour,
      dash: [6, 3 + i],
      size: 5,
      points: rows.filter((row) => row.roofline[name] > 0).map((row): [number, number] => [row.devices, row.roofline[name]]),
    })),
    { name: "frame", colour: "ink", diamond: true, points: rows.map((row): [number, number] => [row.devices, row.frame_cycles]) },
  ].filter((line) => line.points.length > 0);
  root.append(
    h(
      "figure",
      {},
      h("figcaption", {}, h("strong", {}, "Roofline"), " cycles of the frame over devices, and what it takes at least because of each unit"),
    ),
  );
  plot(root.lastElementChild as HTMLElement, {
    label: `Roofline: ${rows.map((row) => `${row.devices} devices, frame ${row.frame_cycles} cycles, at least ${row.roofline[row.roofline.ruling]} because of ${row.roofline.ruling}`).join("; ")}`,
    x: { name: "devices", log: true, ticks: rows.map((row) => row.devices) },
    y: { name: "cycles", log: true },
    height: 270,
  }, lines);
  root.append(line_legend(lines));
}

function several(root: HTMLElement, result: Result, context: Context): void {
  const show = figures_of(context.index, result);
  const rows: Result[] = result.by_devices ?? [result.scaling];
  const last = rows[rows.length - 1];
  root.append(h("h3", {}, rows.length > 1 ? "Several devices" : `${last.devices} devices`));
  const at = result.by_devices ? ["by_devices", rows.length - 1] : ["scaling"];
  root.append(
    h(
      "p",
      {},
      show([...at, "devices"]),
      " devices are ",
      show([...at, "speed_up"], { digits: 2 }),
      " times as fast as one; ",
      show([...at, "efficiency"], { scale: 100, digits: 1, unit: "%" }),
      ` of all cycles are work, the limit is ${plain(last.limit.name)} (`,
      show([...at, "limit", "share"], { scale: 100, digits: 1, unit: "%" }),
      `): ${last.limit.help}.`,
    ),
  );
  const parts = grid(root);
  const left = cell(parts);
  stacks(
    left,
    {
      title: "Where all devices' cycles go",
      label: rows.map((row) => `${row.devices} devices: ${shares.map(([name]) => `${plain(name)} ${row.shares[name]}`).join(", ")}`).join("; "),
      unit: "% of devices x frame",
      most: 100,
    },
    rows.map((row) => {
      const all = row.devices * row.frame_cycles || 1;
      return {
        name: row.devices === 1 ? "1 device" : `${row.devices} devices`,
        shown: `${number_text((100 * row.shares.work) / all, { digits: 1 })} % work`,
        parts: shares.map(([name, colour, meaning]) => ({
          name,
          colour,
          value: (100 * row.shares[name]) / all,
          tip: `${row.devices} devices, ${plain(name)}: ${number_text(row.shares[name])} cycles, ${number_text((100 * row.shares[name]) / all, { digits: 1 })} %; ${meaning}`,
        })),
      };
    }),
  );
  left.append(legend(shares.map(([name, colour]) => ({ name: plain(name), colour }))));
  if (rows.length > 1) roofline(cell(parts), rows);
  else if (last.each?.length > 1) {
    columns(
      cell(parts),
      { title: "Busy cycles of each device", label: last.each.map((one: Result, i: number) => `device ${i}: ${one.busy}`).join(", "), unit: "cycles", x_name: "device" },
      last.each.map((one: Result, i: number) => ({ name: String(i), value: one.busy, tip: `device ${i}: ${number_text(one.busy)} busy cycles, ${one.tiles.length} tiles` })),
    );
  }
  const figure = (...path: string[]) => (row: Result) => [context.index, ...(result.by_devices ? ["by_devices", rows.indexOf(row)] : ["scaling"]), ...path].join(".");
  table(root, {
    label: "By devices",
    rows,
    columns: [
      { name: "Devices", value: (row) => row.devices, figure: figure("devices") },
      { name: "Frame", unit: "cycles", value: (row) => row.frame_cycles, figure: figure("frame_cycles") },
      ...(last.clock_mhz
        ? [
            { name: "Frame", unit: "ms", value: (row: Result) => row.milliseconds, style: { digits: 3 }, figure: figure("milliseconds") },
            { name: "Rate", unit: "fps", value: (row: Result) => row.fps, style: { digits: 2 }, figure: figure("fps") },
          ]
        : []),
      { name: "Speed-up", value: (row) => row.speed_up, style: { digits: 3 }, figure: figure("speed_up") },
      { name: "Efficiency", unit: "%", value: (row) => row.efficiency, style: { scale: 100, digits: 1 }, figure: figure("efficiency") },
      { name: "Limit", value: (row) => plain(row.limit?.name ?? "") },
      { name: "Ruling bound", value: (row) => plain(row.roofline?.ruling ?? "") },
      { name: "Bytes in", value: (row) => row.bytes_in, figure: figure("bytes_in") },
      { name: "Bytes out", value: (row) => row.bytes_out, figure: figure("bytes_out") },
    ],
  });
}

/** `--cull-table`: the same frame with every cull.map, from a source that sends all beats or skips hidden groups. */
function culling(root: HTMLElement, result: Result, context: Context): void {
  const rows: Result[] = result.cull_table;
  const show = figures_of(context.index, result);
  const best = rows.reduce((least, row) => (row.cycles < least.cycles ? row : least), rows[0]);
  const at = (row: Result, ...path: string[]): (string | number)[] => ["cull_table", rows.indexOf(row), ...path];
  const name = (row: Result): string => `${row.cull_map === "off" ? "no culling" : `by ${row.cull_map}`}, ${row.fetch ? "fetched" : "all sent"}`;
  root.append(
    h("h3", {}, "Occlusion culling"),
    h(
      "p",
      {},
      best.cull_map === "off" ? "Culling saves no cycles of this frame. " : [h("strong", {}, name(best)), ": ", show(at(best, "times_fewer"), { digits: 2 }), " times fewer cycles than without culling, ", show(at(best, "share_drawn"), { scale: 100, digits: 1, unit: "%" }), " of the splats are drawn. "],
      "Hidden splats change no pixel; all rows give the same picture. All sent: every splat comes to the device. Fetched: the source asks first, and hidden splats stay in memory.",
    ),
  );
  stacks(
    cell(root),
    { title: "Cycles of the frame", about: "by what is culled (cull.map) and how splats come", label: rows.map((row) => `${name(row)}: ${row.cycles}`).join("; "), unit: "cycles" },
    rows.map((row) => ({ name: name(row), shown: number_text(row.cycles), parts: [{ name: "cycles", value: row.cycles, colour: row.cull_map === "off" ? "c7" : "c0", tip: `${name(row)}: ${number_text(row.cycles)} cycles` }] })),
  );
  const figure = (...path: string[]) => (row: Result): string => path_text(context.index, at(row, ...path));
  table(root, {
    label: "Culling",
    rows,
    columns: [
      { name: "Culling", value: name },
      { name: "Memory latency", unit: "cycles", value: (row) => row.fetch_latency, figure: figure("fetch_latency") },
      { name: "Cycles", value: (row) => row.cycles, figure: figure("cycles") },
      { name: "Fewer", unit: "times", value: (row) => row.times_fewer, style: { digits: 2 }, figure: figure("times_fewer") },
      { name: "Drawn", unit: "% of the splats", value: (row) => row.share_drawn, style: { scale: 100, digits: 1 }, figure: figure("share_drawn") },
      { name: "Windows", value: (row) => row.windows, figure: figure("windows") },
      ...["hidden", "records", "map", "input", "pixels"].map((cause) => ({ name: plain(cause), unit: "cycles", value: (row: Result) => row.account?.[cause], figure: figure("account", cause) })),
    ],
  });
}

export const cycles: Panel = {
  name: "cycles",
  verbs: ["cycles"],
  title: (result) => (result.cull_table ? "Cycles with and without culling" : result.by_devices || result.scaling?.devices > 1 ? "Cycles of several devices" : "Cycles"),
  about: "Clock cycles of a frame and where they go.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const losses = Object.entries(result.cycles.account as Record<string, number>).filter(([name]) => name !== "ideal");
    const [worst, most] = losses.reduce((best, each) => (each[1] > best[1] ? each : best), ["", 0]);
    const many = result.scaling?.devices > 1;
    root.append(
      lead(
        null,
        show(["cycles", "actual"]),
        many ? ` busy cycles of ${result.scaling.devices} devices, ` : " busy cycles, ",
        show(["actual_to_ideal"], { digits: 4 }),
        " times the ideal ",
        show(["cycles", "account", "ideal"]),
        many ? "." : most > 0 ? ["; most is lost to ", h("strong", {}, plain(worst)), " (", show(["cycles", "account", worst]), `): ${causes[worst] ?? ""}.`] : "; nothing is lost.",
      ),
      note([made_of(result), `input ${result.input}, sink ${result.ready}`].filter(Boolean).join("; ")),
      tiles(
        result.scaling?.clock_mhz && [`At ${result.scaling.clock_mhz} MHz`, show(["scaling", "fps"], { digits: 2, unit: "fps" })],
        result.scaling?.clock_mhz && ["Frame", show(["scaling", "milliseconds"], { digits: 3, unit: "ms" })],
        ["Splats/cycle", show(["splats_per_cycle"], { digits: 3 })],
        ["Array used", show(["utilisation"], { scale: 100, digits: 1, unit: "%" })],
        ["Splats", show(["splats"])],
        ["Windows", show(["windows"])],
        ["Tiles", show(["tiles"])],
        result.energy && ["Energy, µJ", show(["energy", "low_uj"], { digits: 0 }), " to ", show(["energy", "high_uj"], { digits: 0 })],
        typeof result.hidden_share === "number" && ["Hidden splats", show(["hidden_share"], { scale: 100, digits: 1, unit: "%" })],
        ["Idle", show(["cycles", "idle"], { unit: "cycles" })],
      ),
    );
    account(cell(root), result);
    if (result.cull_table?.length) culling(root, result, context);
    if (result.timeline?.sheets?.length) timeline(root, result, context);
    if (result.scaling && (many || result.by_devices)) several(root, result, context);
  },
};
