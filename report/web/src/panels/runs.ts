// SPDX-License-Identifier: Apache-2.0
// `render`, `stream record` and `stream replay`: engine, size, counters, saturation.
import { command_button, h } from "../dom";
import { number_text, path_text } from "../figures";
import { verb_of, type Item, type Panel, type Result } from "../page";
import { lead, note } from "../parts";
import { subject_of, subject_text } from "../subject";
import { table } from "../table";

const engine = (result: Result): string => result.engine ?? verb_of(result);
const run = (result: Result): string => `${engine(result)}: ${subject_text(subject_of([result]))}`;
const scan = (result: Result): string => subject_text({ ...subject_of([result]), configs: [], sizes: [] });

export const runs: Panel = {
  name: "runs",
  verbs: ["render", "stream record", "stream replay"],
  once: true,
  title: "What was drawn",
  about: "Which pictures and streams were made, by which engine, and what the device counted.",
  render(root, _result, context) {
    const { items } = context;
    const drawn = items.filter(({ result }) => result.scene?.width);
    const scenes = [...new Set(items.map(({ result }) => subject_text({ ...subject_of([result]), configs: [] })))];
    const saturated = items.filter(({ result }) => Object.entries((result.counters ?? {}) as Record<string, number>).some(([name, count]) => name.endsWith("_saturated") && count > 0));
    root.append(
      lead(
        null,
        `${scenes.join("; ") || "Recorded streams"}: `,
        [...new Set(items.map(({ result }) => engine(result)))].join(", "),
        ". ",
        items.some(({ result }) => result.counters) ? (saturated.length ? `Words saturated in ${saturated.map(({ result }) => engine(result)).join(", ")}: see the counters.` : "No word of the device saturated.") : "",
      ),
    );
    const at = (...path: string[]) => ({ index }: Item) => path_text(index, path);
    table(root, {
      label: "What was drawn",
      rows: items,
      columns: [
        { name: "Engine", value: ({ result }) => engine(result) },
        { name: "Scan", value: ({ result }) => scan(result) },
        { name: "Picture", unit: "pixels", value: ({ result }) => subject_of([result]).sizes.join(", ").replaceAll(" pixels", "") },
        { name: "Method", value: ({ result }) => result.scene?.method },
        { name: "Configuration", value: ({ result }) => (result.config ? `${result.config.name ?? result.config} ${result.config.hash ?? result.config_hash ?? ""}` : null) },
        { name: "Voxels", value: ({ result }) => result.voxels, figure: at("voxels") },
        { name: "Sheets", value: ({ result }) => result.sheets, figure: at("sheets") },
        { name: "Tiles", value: ({ result }) => result.tiles, figure: at("tiles") },
        { name: "Splat records", value: ({ result }) => result.driver?.splat_records, figure: at("driver", "splat_records") },
        { name: "Windows", value: ({ result }) => result.counters?.windows, figure: at("counters", "windows") },
        { name: "Time", unit: "s", value: ({ result }) => result.seconds, style: { digits: 2 }, figure: at("seconds") },
        { name: "Files", value: ({ result }) => (result.outputs ?? []).join(", ") },
        { name: "Command", value: () => "", cell: ({ result }) => (result.command ? command_button(result.command, "this picture") : null) },
      ],
    });
    for (const { index, result } of items.filter((item) => item.result.counters)) {
      const names = Object.keys(result.counters);
      root.append(
        h(
          "details",
          { open: saturated.some((item) => item.index === index) },
          h("summary", {}, `Counters of ${run(result)}`),
          h("dl", { class: "tiles" }, names.map((name) => h("div", {}, h("dt", {}, name.replaceAll("_", " ")), h("dd", {}, h("span", { class: "figure", "data-figure": path_text(index, ["counters", name]) }, number_text(result.counters[name])))))),
        ),
      );
    }
    for (const { result } of drawn) {
      if (!result.scene.toml) continue;
      root.append(h("details", {}, h("summary", {}, `Scene of ${run(result)}`), h("pre", {}, result.scene.toml)));
    }
    if (items.some(({ result }) => result.driver?.vanished_voxels > 0))
      root.append(note(items.filter(({ result }) => result.driver?.vanished_voxels > 0).map(({ result }) => `${engine(result)}: ${number_text(result.driver.vanished_voxels)} voxels are too faint for the words of the driver and vanished.`).join(" ")));
  },
};
