// SPDX-License-Identifier: Apache-2.0
// Early termination: how many pixels, from which sheet to which, and a map of the sheets for the viewer.
import { h } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import type { Result } from "../../../report/web/src/page";
import type { Answer } from "./answers";
import { Asked } from "./asked";

type Picture = Answer["pictures"][0];

export class TerminatedPart extends Asked {
  constructor(ask: () => void) {
    super("terminated", "Early termination", "Which pixels terminate?", "Maps the sheet in which each pixel's transmittance falls below composite.freeze_below; what lies behind it cannot change the pixel.", ask);
  }

  protected fill(body: HTMLElement, { pixels, of, first, last, freeze_below }: Result): void {
    const share = number_text((100 * pixels) / of, { digits: 1 });
    const sheets = first === last ? `sheet ${first}` : `sheets ${first} to ${last}`;
    const text = pixels === 0 ? `No pixel terminates early (composite.freeze_below = ${freeze_below}).` : `${number_text(pixels)} of ${number_text(of)} pixels terminate early (${share} %), in ${sheets}.`;
    body.append(h("p", { id: "terminated-pixels" }, text));
  }
}

const early = [253, 231, 37], late = [68, 1, 84], never = [40, 40, 40];

/** The map in colours: the words are the sheet's number plus 1, or 0. */
export function drawn_sheets({ head, words }: Picture): Picture & { note: string } {
  const some = words.filter((word) => word > 0);
  const first = some.reduce((a, b) => Math.min(a, b), head.scale), span = Math.max(1, head.scale - first);
  const colours = new Int32Array(3 * words.length);
  words.forEach((word, i) => colours.set(word === 0 ? never : early.map((from, c) => Math.round(from + ((late[c] - from) * (word - first)) / span)), 3 * i));
  const note = some.length ? `Yellow: sheet ${first - 1}, the first. Violet: sheet ${head.scale - 1}, the last. Grey: never.` : "Grey: no pixel terminates.";
  return { head: { ...head, channels: 3, scale: 255 }, words: colours, note };
}
