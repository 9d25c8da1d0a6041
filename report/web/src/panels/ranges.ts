// SPDX-License-Identifier: Apache-2.0
// `errors ranges`: the values at the device's narrowing sites, bit by bit.
import { h, s, type Child } from "../dom";
import { at, figures_of, number_text, type Path } from "../figures";
import type { Panel, Result } from "../page";
import { lead, made_of, note } from "../parts";
import { drawing, line, text } from "../svg";
import { numbers_of, table } from "../table";

/** Weights of a word's first and last bit, from its format: "U 2.16", "S 12.6", "One.16" (0..1, both ends). */
export function word_bits(format: string): { first: number; last: number } | null {
  const fixed = /^[US] (-?\d+)\.(-?\d+)$/.exec(format);
  if (fixed) return { first: Number(fixed[1]) - 1, last: -Number(fixed[2]) };
  const one = /^One\.(\d+)$/.exec(format);
  return one ? { first: 0, last: -Number(one[1]) } : null;
}

function bits(root: HTMLElement, sites: Result[]): void {
  const words = sites.map((site) => word_bits(site.format));
  const weights = sites.flatMap((site, i) => [
    ...(site.histogram ?? []).map((bin: Result) => bin.weight as number),
    ...(words[i] ? [words[i].first, words[i].last] : []),
  ]);
  if (!weights.length) return;
  const [high, low] = [Math.max(...weights), Math.min(...weights)];
  drawing(
    root,
    {
      title: "Leading bits",
      about: "how many values begin with each bit: darker is more, on a logarithmic scale; the frame is the word that is kept",
      label: `Magnitudes by leading bit of ${sites.length} signals, from 2 to the ${high} down to 2 to the ${low}`,
    },
    (to) => {
      const left = 96;
      const row = 26;
      const step = (to.width - left - 2) / (high - low + 1);
      const x = (weight: number): number => left + (high - weight) * step;
      const bottom = sites.length * row + 4;
      to.height(bottom + 34);
      for (let weight = high, free = -99; weight >= low; --weight) {
        const shown = weight % 4 === 0;
        if (shown) to.svg.append(line(x(weight) + step / 2, 0, x(weight) + step / 2, bottom, { class: "gridline" }));
        const label = `2^${weight}`;
        if (!shown || x(weight) < free) continue;
        free = x(weight) + label.length * 7 + 8;
        to.svg.append(
          s("text", { x: x(weight) + step / 2, y: bottom + 16, class: "tick", "text-anchor": "middle" }, "2", s("tspan", { dy: -4, "font-size": 9 }, String(weight).replace("-", "\u2212"))),
        );
      }
      sites.forEach((site, i) => {
        const y = i * row + 3;
        to.svg.append(text(left - 8, y + row / 2 + 3, site.site, { "text-anchor": "end" }));
        const most = Math.log1p(Math.max(1, ...(site.histogram ?? []).map((bin: Result) => bin.values as number)));
        for (const bin of site.histogram ?? []) {
          if (!bin.values) continue;
          const strength = 0.15 + 0.85 * (Math.log1p(bin.values) / most);
          const place = s("rect", { x: x(bin.weight) + 0.5, y: y + 2, width: Math.max(1, step - 1), height: row - 8, fill: "var(--c0)", "fill-opacity": strength.toFixed(3) });
          to.svg.append(place);
          to.tip(place, `${site.site}: ${number_text(bin.values)} values from 2^${bin.weight} to 2^${bin.weight + 1}, of ${number_text(site.values)}`);
        }
        const word = words[i];
        if (!word) return;
        const frame = { y: y + 0.5, height: row - 5, fill: "none", stroke: "var(--soft)" };
        to.svg.append(s("rect", { x: x(word.first), width: (word.first - word.last + 1) * step, ...frame }));
      });
    },
  );
}

export const ranges: Panel = {
  name: "ranges",
  verbs: ["errors ranges"],
  title: "Ranges of the signals",
  about: "Which values each signal of the device took, beside the word that holds it. ulp: the last bit of that word.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const sites: Result[] = result.sites ?? [];
    const needs: Result[] = result.needs ?? [];
    const spare = needs.filter((need) => need.needs < need.has);
    const saturated = sites.filter((site) => site.saturated > 0);
    root.append(
      lead(
        null,
        saturated.length ? `${saturated.map((site) => site.site).join(", ")} saturated. ` : "Nothing saturated. ",
        spare.length
          ? [
              spare.length === 1 ? "One width is " : `${spare.length} widths are `,
              "larger than this scene needs: ",
              spare.map((need, i) => [i ? ", " : "", h("code", {}, need.key), " ", show(["needs", needs.indexOf(need), "has"]), " \u2192 ", show(["needs", needs.indexOf(need), "needs"])]),
              ".",
            ]
          : "Every bit of every width was needed.",
      ),
      note([...(result.scenes ?? []).map((scene: Result) => scene.scene), made_of(result)].filter(Boolean).join("; ")),
    );
    bits(root, sites);
    const number = numbers_of(`${context.index}.sites`, sites);
    table(root, {
      label: "Places that narrow",
      rows: sites,
      columns: [
        { name: "Signal", value: (row) => row.site },
        { name: "Word", value: (row) => row.format },
        number("Values", "values"),
        number("Least", "least"),
        number("Greatest", "greatest"),
        { ...number("Saturated", "saturated"), kind: (row) => (row.saturated > 0 ? "fail" : "") },
        number("Head unused", "unused_head_bits", "bits"),
        number("Tail idle", "idle_tail_bits", "bits"),
        number("Dropped", "dropped_bits", "bits"),
        number("Lost, mean", "lost.mean_ulp", "ulp", { digits: 4, sign: true }),
        number("Lost, RMS", "lost.rms_ulp", "ulp", { digits: 4 }),
        number("RMS in theory", "theory.rms_ulp", "ulp", { digits: 4 }),
      ],
    });
    const derived: Result[] = result.derived ?? [];
    if (derived.length) {
      root.append(h("h3", {}, "Ranges of any scene"), note("Derived from the configuration alone. Tight: no scene saturates the word, and one bit less could. Unused: leading bits that no scene needs."));
      const both = (row: Result, ends: Path[]): Child => ends.map((end, i) => [i ? " to " : "", show(["derived", derived.indexOf(row), ...end], { digits: Number.isInteger(at(row, end)) ? 0 : 5 })]);
      table(root, {
        label: "Ranges of any scene",
        rows: derived,
        columns: [
          { name: "Signal", value: (row) => row.site },
          { name: "Word", value: (row) => row.format },
          { name: "These scenes", value: (row) => row.simulated?.[1], cell: (row) => (row.simulated ? both(row, [["simulated", 0], ["simulated", 1]]) : "\u2013") },
          { name: "Any scene", value: (row) => row.greatest, cell: (row) => both(row, [["least"], ["greatest"]]) },
          { name: "Verdict", value: (row) => (row.verdict === "wasteful" ? `${row.unused_head_bits} unused` : row.verdict), kind: (row) => (row.verdict === "saturates" ? "fail" : "") },
        ],
      });
    }
    if (!needs.length) return;
    root.append(h("h3", {}, "Widths of the configuration"));
    const width = numbers_of(`${context.index}.needs`, needs);
    table(root, {
      label: "Widths",
      rows: needs,
      columns: [
        { name: "Key", value: (row) => row.key },
        width("Has", "has", "bits"),
        width("Needs", "needs", "bits"),
        width("Possible", "possible", "bits"),
        { name: "Why", value: (row) => row.why },
        { name: "Limit", value: (row) => row.limit, kind: () => "wrap" },
      ],
    });
  },
};
