// SPDX-License-Identifier: Apache-2.0
// `errors bound`: the proved bound of every value's error, at three levels of knowledge.
import { stacks } from "../bars";
import { figures_of, number_text } from "../figures";
import type { Panel, Result } from "../page";
import { cell, lead, made_of, note } from "../parts";
import { legend } from "../svg";
import { numbers_of, table } from "../table";

const colours = ["c3", "c0", "c1", "c2", "c4", "c5"];
const known: Record<string, string> = {
  scene: "scene: the scene and the configuration",
  geometry: "geometry: places, weights and depths as well",
  words: "words: every word of the driver",
};

export const bound: Panel = {
  name: "bound",
  verbs: ["errors bound"],
  title: "Bound of the error",
  about: "The largest error that each step of the arithmetic can cause, as proved, beside the largest that occurred. LSB8: a step of an 8-bit pixel, 1/255.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const levels: Result[] = result.levels ?? [];
    root.append(
      lead(
        result.holds ? "pass" : "fail",
        result.holds ? "No value errs by more than its bound: " : "A value errs by more than its bound: ",
        show(["levels", 0, "greatest_error_lsb8"]),
        " seen, at most ",
        show(["levels", 0, "greatest_bound_lsb8"], { unit: "LSB of 8 bits" }),
        " proved.",
      ),
      note(made_of(result)),
    );
    // The parts that are largest over all levels get a colour each, the others share one.
    const sums = new Map<string, number>();
    for (const level of levels) for (const [name, value] of Object.entries(level.mean_lsb8 as Record<string, number>)) sums.set(name, Math.max(sums.get(name) ?? 0, value));
    const large = [...sums].sort((a, b) => b[1] - a[1]).slice(0, colours.length).map(([name]) => name);
    const place = cell(root);
    stacks(
      place,
      {
        title: "What the bound consists of",
        about: "mean over the values, by step",
        label: levels.map((level) => `${level.known}: ${Object.entries(level.mean_lsb8).map(([name, value]) => `${name} ${number_text(value)}`).join(", ")}`).join("; "),
        unit: "LSB of 8 bits",
      },
      levels.map((level) => {
        const mean = level.mean_lsb8 as Record<string, number>;
        const all = Object.values(mean).reduce((sum, value) => sum + value, 0);
        const rest = all - large.reduce((sum, name) => sum + (mean[name] ?? 0), 0);
        const tip = (name: string, value: number): string => `${level.known}, ${name}: ${number_text(value)} LSB8, ${number_text((100 * value) / (all || 1), { digits: 1 })} %`;
        return {
          name: level.known,
          shown: number_text(all, { digits: 3 }),
          parts: [
            ...large.map((name, i) => ({ name, value: mean[name] ?? 0, colour: colours[i], tip: tip(name, mean[name] ?? 0) })),
            { name: "others", value: Math.max(0, rest), colour: "c7", tip: tip("others", rest) },
          ],
        };
      }),
    );
    place.append(legend([...large.map((name, i) => ({ name, colour: colours[i] })), { name: "others", colour: "c7" }]));
    const number = numbers_of(`${context.index}.levels`, levels);
    table(root, {
      label: "Levels of the bound",
      rows: levels,
      columns: [
        { name: "Known", value: (row) => known[row.known] ?? row.known },
        number("Values", "values"),
        { ...number("Over the bound", "over"), kind: (row) => (row.over > 0 ? "fail" : "") },
        number("Greatest error", "greatest_error_lsb8", "LSB8", { digits: 3 }),
        number("Greatest bound", "greatest_bound_lsb8", "LSB8", { digits: 3 }),
        number("Error / bound, at most", "greatest_error_to_bound", "times", { digits: 4 }),
        number("Bound / error, median", "bound_to_error.median", "times", { digits: 1 }),
        number("90 %", "bound_to_error.p90", "times", { digits: 1 }),
        number("99 %", "bound_to_error.p99", "times", { digits: 1 }),
        { name: "Dominant", value: (row) => row.dominant },
      ],
    });
  },
};
