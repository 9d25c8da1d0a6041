// SPDX-License-Identifier: Apache-2.0
// `errors file`: what encoding a scene costs, attribute by attribute, and the device behind it.
import { waterfall } from "../bars";
import { figures_of, number_text } from "../figures";
import type { Panel, Result } from "../page";
import { cell, lead, made_of, note, tiles } from "../parts";
import { legend } from "../svg";
import { numbers_of, table } from "../table";

const colours: Record<string, string> = { file: "c0", device: "c1" };

/** From the trained scene to the device's word: attributes, their sum, steps, the whole. */
function chain(root: HTMLElement, parts: Result[]): void {
  const percent = (value: number): string => `${number_text(value, { digits: 1 })} %`;
  const share = (of: Result[]): number => 100 * of.reduce((sum, part) => sum + part.share, 0);
  const file = parts.filter((part) => part.by === "file");
  const fall = (part: Result): Parameters<typeof waterfall>[2][number] => ({
    name: part.name,
    value: 100 * part.share,
    shown: number_text(100 * part.share, { digits: 1, sign: true }) + " %",
    tip: `${part.name} (${part.by}): ${percent(100 * part.share)}, RMS ${number_text(part.rms_lsb8)} LSB of 8 bits`,
    colour: colours[part.by],
  });
  const sum = (name: string, value: number): Parameters<typeof waterfall>[2][number] => ({ name, value, shown: percent(value), tip: `${name}: ${percent(value)}`, total: true });
  waterfall(
    root,
    {
      title: "From the trained scene to the device's word",
      about: "share of the squared error that comes in with each; they add up to all of it",
      label: `Waterfall of the shares: ${parts.map((part) => `${part.name} ${percent(100 * part.share)}`).join(", ")}`,
      unit: "% of the squared error",
    },
    [...file.map(fall), sum("file", share(file)), ...parts.filter((part) => part.by === "device").map(fall), sum("both", share(parts))],
  );
}

export const errors_file: Panel = {
  name: "errors-file",
  verbs: ["errors file"],
  title: "What the file costs",
  about: "How much of the picture's error is the encoded file's, by attribute of its Gaussians, and how much the device's, by step. LSB8: a step of an 8-bit pixel, 1/255.",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    const parts: Result[] = result.parts;
    root.append(
      lead(
        null,
        "The file is ",
        show(["file", "psnr_db"], { digits: 1, unit: "dB" }),
        " from the original, the device ",
        show(["device", "psnr_db"], { digits: 1, unit: "dB" }),
        " from the file, both together ",
        show(["total", "psnr_db"], { digits: 1, unit: "dB" }),
        ".",
      ),
      note(made_of(result)),
      tiles(
        ["Original", show(["original"]), " Gaussians"],
        ["Encoded", show(["encoded"])],
        ["Matched", show(["matched"])],
        ["RMS, file", show(["file", "rms_lsb8"]), " LSB8"],
        ["RMS, device", show(["device", "rms_lsb8"]), " LSB8"],
        ["RMS, both", show(["total", "rms_lsb8"]), " LSB8"],
      ),
    );
    const place = cell(root);
    chain(place, parts);
    place.append(legend([{ name: "file", colour: "c0" }, { name: "device", colour: "c1" }, { name: "sum", colour: "c7" }]));
    const number = numbers_of(`${context.index}.parts`, parts);
    table(root, {
      label: "Attributes and steps",
      rows: parts,
      columns: [
        { name: "Part", value: (row) => row.name },
        { name: "By", value: (row) => row.by },
        number("Share", "share", "%", { scale: 100, digits: 2 }),
        number("RMS", "rms_lsb8", "LSB8", { digits: 4 }),
        number("Max", "max_lsb8", "LSB8", { digits: 3 }),
        number("Alone", "alone.psnr_db", "dB", { digits: 1 }),
      ],
    });
  },
};
