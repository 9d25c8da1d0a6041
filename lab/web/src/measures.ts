// SPDX-License-Identifier: Apache-2.0
// The figures of a frame: error, hash, cost, synthesis, and the histogram of the error at rest.
import { clear, h, type Child } from "../../../report/web/src/dom";
import { figures_of, number_text } from "../../../report/web/src/figures";
import type { Result } from "../../../report/web/src/page";
import { histogram } from "../../../report/web/src/panels/compare";
import { cost_unit, note, tiles } from "../../../report/web/src/parts";
import type { Frame } from "./answers";
import type { Shown } from "./drawer";

function error_tiles(compare: Result): HTMLElement {
  const show = figures_of(0, compare);
  const lsb = (): HTMLElement => h("small", {}, ` LSB of ${compare.lsb_bits} bits`);
  return tiles(
    ["PSNR", compare.identical ? "identical" : show(["psnr_db"], { digits: 2, unit: "dB" })],
    ["Largest error", show(["max_abs_lsb"], { digits: 3 }), lsb()],
    ["RMSE", show(["rmse_lsb"]), h("small", {}, " LSB")],
    ["Bias", show(["bias_lsb"], { sign: true }), h("small", {}, " LSB")],
    ["SSIM", show(["ssim"], { digits: 6 })],
    typeof compare.floor?.psnr_db === "number" && ["Floor", show(["floor", "psnr_db"], { digits: 2, unit: "dB" }), h("small", {}, ` rounded once to ${compare.lsb_bits} bits`)],
  );
}

function device_tiles(frame: Frame): HTMLElement {
  const { config, words_hash } = frame;
  const show = figures_of(0, frame as unknown as Result);
  const estimated = config.area ? { "xc7, estimated": config.area } : {};
  const technologies: [string, ...Child[]][] = Object.entries({ ...config.synthesis, ...estimated }).map(([name, counts]) => [
    `Area, ${name}`,
    `${number_text(counts.lut)} LUT, ${number_text(counts.dsp)} DSP`,
    h("small", {}, ` ${number_text(counts.ff)} FF, ${number_text(counts.bram)} BRAM`),
  ]);
  return tiles(
    ["Hash of the words", h("code", { id: "words-hash" }, words_hash ?? "\u2013")],
    ["Splat records", show(["records"])],
    ["Storage", show(["config", "cost", "storage_bits"]), h("small", {}, " bits")],
    ["Adders", show(["config", "cost", "adder_bits"]), h("small", {}, " bits")],
    ["Multipliers", show(["config", "cost", "multiplier_bits"]), h("small", {}, ` ${cost_unit}`)],
    ["Cost", show(["config", "cost", "total"]), h("small", {}, ` ${cost_unit}`)],
    ...technologies,
  );
}

export class Measures {
  readonly root = h("section", { class: "box", id: "measures", "aria-label": "Error and cost" });
  private readonly lines = h("div", { id: "figures" });
  /** Read aloud when a picture is complete. */
  private readonly spoken = h("p", { class: "off", role: "status" });
  private readonly chart = h("div", { class: "solo" });

  constructor() {
    this.root.append(this.spoken, this.lines, h("details", { open: true }, h("summary", {}, "Histogram of the error"), this.chart));
  }

  show({ frame, draft, ms }: Shown): void {
    const { compare } = frame;
    this.lines.replaceChildren(
      h("p", { class: "note", id: "made" }, `${frame.width} \u00d7 ${frame.height} pixels${draft ? " while moving" : ""}, configuration ${frame.config.name} ${frame.config.hash}, ${Math.round(ms)} ms`),
      ...(frame.device_error ? [] : [error_tiles(compare)]),
      device_tiles(frame),
      ...frame.remarks.map((remark) => note(remark)),
    );
    if (draft) return;
    this.spoken.textContent = frame.device_error ?? (compare.identical ? "The pictures are identical." : `PSNR ${number_text(compare.psnr_db, { digits: 2 })} dB, largest error ${number_text(compare.max_abs_lsb)} LSB.`);
    clear(this.chart);
    if (compare && !compare.identical) histogram(this.chart, compare);
  }
}
