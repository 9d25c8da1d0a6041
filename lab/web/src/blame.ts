// SPDX-License-Identifier: Apache-2.0
// Which step errs: each step's part of the error, by a button since it draws many frames. Its map goes to the viewer.
import { h } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import type { Result } from "../../../report/web/src/page";
import { table } from "../../../report/web/src/table";
import { Asked } from "./asked";

interface Step {
  name: string;
  by: string;
  meaning: string;
  keys: string;
  share: number;
  increment: { rms_lsb8: number; max_lsb8: number; bias_lsb8: number };
  pixels_ruled: number;
}

export class BlamePart extends Asked {
  constructor(ask: () => void) {
    super("errors", "Error by step", "Which step errs?", "Replaces the steps of the computation by real arithmetic, one after the other, and maps which of them errs most in every pixel.", ask);
  }

  protected fill(body: HTMLElement, errors: Result): void {
    const steps = [...(errors.steps as Step[])].sort((a, b) => b.share - a.share);
    body.append(h("p", {}, `The device's steps cause ${number_text(100 * errors.device_share, { digits: 1 })} % of the squared error, the driver's ${number_text(100 * errors.driver_share, { digits: 1 })} %.`));
    table(body, {
      label: "Error by step",
      rows: steps,
      columns: [
        { name: "Step", value: (row) => row.name },
        { name: "Share", unit: "%", value: (row) => 100 * row.share, style: { digits: 2 } },
        { name: "RMS", unit: "LSB", value: (row) => row.increment.rms_lsb8 },
        { name: "Max", unit: "LSB", value: (row) => row.increment.max_lsb8 },
        { name: "Most in", unit: "% of pixels", value: (row) => 100 * row.pixels_ruled, style: { digits: 2 } },
        { name: "By", value: (row) => row.by },
        { name: "Keys", value: (row) => row.keys, cell: (row) => h("code", {}, row.keys) },
        { name: "Meaning", value: (row) => row.meaning },
      ],
    });
  }
}
