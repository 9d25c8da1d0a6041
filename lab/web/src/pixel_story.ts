// SPDX-License-Identifier: Apache-2.0
// One pixel's whole computation: steps, sheets, and the splats of a sheet, as words and values, device beside real.
import { clear, h } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import { table, type Column } from "../../../report/web/src/table";
import type { Story, Value } from "./answers";

type Sheet = Story["sheets"][0];
type Share = Sheet["shares"][0];

/** Word, value and real value of a number, the last two shortened. */
function cell(value: Value | undefined): HTMLElement | string {
  if (!value) return "\u2013";
  const { word, device, real } = value;
  const title = `device ${device ?? "\u2013"}${word === null ? "" : `, word ${word}`}; real ${real ?? "\u2013"}`;
  return h("span", { class: "value", title }, h("b", {}, word === null ? number_text(device) : String(word)), h("span", {}, number_text(device)), h("span", { class: "real" }, number_text(real)));
}

function column<Row>(name: string, bits: Record<string, number>, of: (row: Row) => Value | undefined): Column<Row> {
  return { name, unit: name in bits ? `2^\u2212${bits[name]}` : undefined, value: (row) => of(row)?.device ?? null, cell: (row) => cell(of(row)) };
}

export class PixelStory {
  readonly root: HTMLDetailsElement;
  private readonly body = h("div", {}, h("p", { class: "note" }, "Click a pixel of a picture."));
  private readonly splats = h("div", { class: "sheets" });
  private chosen: Sheet | undefined;
  private chosen_name: number | undefined;

  constructor(opened: () => void) {
    this.root = h("details", { class: "box", id: "pixel", toggle: () => this.root.open && opened() }, h("summary", {}, h("h2", {}, "Pixel story")), this.body);
  }

  get open(): boolean {
    return this.root.open;
  }

  wait(text = ""): void {
    this.root.classList.add("stale");
    if (text) this.body.replaceChildren(h("p", { class: "note" }, text));
  }

  fail(message: string): void {
    this.root.classList.remove("stale");
    this.body.replaceChildren(h("p", { class: "wrong-line", role: "alert" }, message));
  }

  show(story: Story): void {
    this.root.classList.remove("stale");
    clear(this.body);
    const names = Object.keys(story.pixel);
    // A Gaussian is a sample of its own, in place of a sheet.
    const gaussians = story.splats[0]?.gaussian !== undefined;
    const kind = gaussians ? "Gaussian" : "sheet";
    const name_of = (row: Sheet | undefined): number | undefined => (gaussians ? story.splats[row?.shares[0]?.splat ?? 0]?.gaussian : row?.sheet);
    this.body.append(
      h(
        "p",
        { id: "pixel-lead", "data-pixel": `${story.x},${story.y}` },
        `Pixel (${story.x}, ${story.y}): ${gaussians ? `${story.splats.length} Gaussians` : `${story.splats.length} splats in ${story.sheets.length} sheets`}${story.terminated ? `; it terminates early, in ${kind} ${name_of(story.sheets.at(-1))}` : ""}. `,
        `The error is ${names.map((name, i) => `${name} ${number_text(story.error_lsb8[i], { digits: 3, sign: true })}`).join(", ")} LSB of 8 bits.`,
      ),
      h("h3", {}, "Each step's part of the error"),
    );
    table(this.body, {
      label: "Each step's part of the pixel's error, LSB of 8 bits",
      rows: story.steps,
      columns: [
        { name: "Step", value: (row) => row.name },
        ...names.map((name, i) => ({ name, unit: "LSB", value: (row: Story["steps"][0]) => row.error_lsb8[i] ?? null, style: { digits: 4, sign: true } })),
        { name: "By", value: (row) => row.by },
        { name: "Keys", value: (row) => row.keys, cell: (row) => h("code", {}, row.keys) },
      ],
    });
    this.body.append(h("h3", {}, gaussians ? "Gaussian by Gaussian" : "Sheet by sheet"), h("p", { class: "note" }, `Each cell: the device's word, its value, and the value in real arithmetic. Choose a ${kind} to see ${gaussians ? "its place and weight" : "its splats"}.`));
    const keys = [...new Set(story.sheets.flatMap((sheet) => Object.keys(sheet.together)))];
    this.chosen = story.sheets.find((sheet) => name_of(sheet) === this.chosen_name) ?? story.sheets[0];
    this.chosen_name = name_of(this.chosen);
    const sheets = h("div", { class: "sheets" });
    this.body.append(sheets);
    const rows = table<Sheet>(sheets, {
      label: gaussians ? "Gaussians of the pixel" : "Sheets of the pixel",
      rows: story.sheets,
      chosen: (row) => row === this.chosen,
      choose: (row) => {
        this.chosen = row;
        this.chosen_name = name_of(row);
        rows.refresh();
        this.show_splats(story, `${kind} ${this.chosen_name}`);
      },
      columns: [{ name: gaussians ? "Gaussian" : "Sheet", value: (row) => name_of(row) ?? null }, ...(gaussians ? [] : [{ name: "Splats", value: (row: Sheet) => row.shares.length }]), ...keys.map((key) => column<Sheet>(key, story.frac_bits, (row) => row.together[key]))],
    });
    this.body.append(this.splats);
    this.show_splats(story, `${kind} ${this.chosen_name}`);
  }

  private show_splats(story: Story, name: string): void {
    clear(this.splats);
    const sheet = this.chosen;
    if (!sheet) return;
    const heading = name.startsWith("sheet") ? `Splats of ${name}` : name;
    this.splats.append(h("h3", { id: "sheet-splats" }, heading));
    const splat = (row: Share): Story["splats"][0] => story.splats[row.splat];
    const own = [...new Set(sheet.shares.flatMap((row) => Object.keys(splat(row)?.values ?? {})))];
    const shared = [...new Set(sheet.shares.flatMap((row) => Object.keys(row.values)))];
    table<Share>(this.splats, {
      label: heading,
      rows: sheet.shares,
      columns: [
        ...(name.startsWith("sheet") ? [{ name: "Voxel", value: (row: Share) => splat(row)?.voxel?.join(", ") ?? String(row.splat) }] : []),
        ...own.map((key) => column<Share>(key, story.frac_bits, (row) => splat(row)?.values[key])),
        ...shared.map((key) => column<Share>(key, story.frac_bits, (row) => row.values[key])),
      ],
    });
  }
}
