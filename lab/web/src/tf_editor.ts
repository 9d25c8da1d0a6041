// SPDX-License-Identifier: Apache-2.0
// The transfer function's editor: the volume's histogram, and the curve of opacity over it with points to move.
import { h, s } from "../../../report/web/src/dom";
import { number_text } from "../../../report/web/src/figures";
import type { Histogram } from "./answers";
import { at_value, colour_of, hex_of, points_of, rest_of, toml_of, type Point } from "./tf_model";

const tall = 200;
const edge = 10; // around the curve, so that points at the limits can be grasped

export class TfEditor {
  readonly root: HTMLDetailsElement;
  private readonly place = h("div", { class: "tf-plot" });
  private readonly message = h("p", { class: "note" }, "The volume's histogram is asked for when this is opened.");
  private readonly at = h("input", { type: "number", id: "tf-at", step: "any", change: () => this.edit({ at: Number(this.at.value) }) });
  private readonly opacity = h("input", { type: "number", id: "tf-opacity", min: 0, max: 1, step: 0.01, change: () => this.edit({ opacity: Number(this.opacity.value) }) });
  private readonly colour = h("input", { type: "color", id: "tf-colour", input: () => this.edit({ colour: colour_of(this.colour.value) }, true), change: () => this.edit({ colour: colour_of(this.colour.value) }) });
  private readonly fields: HTMLElement;
  private histogram: Histogram | null = null;
  private points: Point[] = [];
  private rest = "";
  private chosen = 0;
  private width = 0;

  constructor(
    opened: () => void,
    /** Called with the edited function as TOML. */
    private readonly changed: (toml: string, live: boolean) => void,
    save: (toml: string) => void,
  ) {
    const button = (id: string, text: string, act: () => void): HTMLElement => h("button", { type: "button", id, click: act }, text);
    this.fields = h(
      "div",
      { class: "controls" },
      h("label", { for: "tf-at" }, "Value", this.at),
      h("label", { for: "tf-opacity" }, "Opacity", this.opacity),
      h("label", { for: "tf-colour" }, "Colour", this.colour),
      button("tf-add", "Add a point", () => this.add()),
      button("tf-remove", "Remove it", () => this.remove()),
      button("tf-save", "Save as TOML", () => save(toml_of(this.points, this.rest))),
    );
    this.root = h(
      "details",
      { class: "box", id: "tf-editor", toggle: () => this.root.open && opened() },
      h("summary", {}, h("h2", {}, "Transfer function")),
      this.message,
      this.place,
      this.fields,
      h("p", { class: "note" }, "Drag points, double-click to add one, Delete removes it. By keyboard: Tab to the points, arrows move one, Page Up and Page Down choose."),
    );
    new ResizeObserver(() => {
      if (this.place.clientWidth !== this.width) this.draw();
    }).observe(this.place);
  }

  get open(): boolean {
    return this.root.open;
  }

  fail(message: string): void {
    this.message.textContent = message;
  }

  show(histogram: Histogram): void {
    this.histogram = histogram;
    this.points = points_of(histogram);
    this.rest = rest_of(histogram.toml);
    this.chosen = Math.min(this.chosen, this.points.length - 1);
    this.message.textContent = `${histogram.dims.join(" \u00d7 ")} voxels, values ${number_text(histogram.min)} to ${number_text(histogram.max)}; counts on a logarithmic scale. Function: ${histogram.tf}.${histogram.toml === undefined ? " An edited preset loses its shading." : ""}`;
    this.draw();
  }

  private edit(part: Partial<Point>, live = false): void {
    const point = this.points[this.chosen];
    if (!point || !this.histogram) return;
    const [before, after] = [this.points[this.chosen - 1], this.points[this.chosen + 1]];
    const { min, max } = this.span;
    // Edited values are rounded, others stay as they are.
    const rounded = (value: number | undefined, otherwise: number): number => (value === undefined ? otherwise : Number(value.toPrecision(6)));
    const next = { ...point, ...part, at: rounded(part.at, point.at), opacity: rounded(part.opacity, point.opacity) };
    next.at = Math.min(after?.at ?? max, Math.max(before?.at ?? min, Number.isFinite(next.at) ? next.at : point.at));
    next.opacity = Math.min(1, Math.max(0, Number.isFinite(next.opacity) ? next.opacity : point.opacity));
    this.points = this.points.map((each, i) => (i === this.chosen ? next : each));
    this.draw();
    this.changed(toml_of(this.points, this.rest), live);
  }

  private add(at?: number, opacity?: number): void {
    if (!this.histogram) return;
    const after = this.points[this.chosen + 1];
    const here = this.points[this.chosen];
    const place = at ?? (after ? (here.at + after.at) / 2 : (here.at + this.span.max) / 2);
    const point = at_value(this.points, place);
    this.points = [...this.points, { ...point, opacity: Number((opacity ?? point.opacity).toPrecision(6)) }].sort((a, b) => a.at - b.at);
    this.chosen = this.points.findIndex((each) => each.at === place);
    this.draw();
    this.changed(toml_of(this.points, this.rest), false);
  }

  private remove(): void {
    if (this.points.length <= 2) return this.fail("A transfer function has two points or more.");
    this.points = this.points.filter((_, i) => i !== this.chosen);
    this.chosen = Math.max(0, this.chosen - 1);
    this.draw();
    this.changed(toml_of(this.points, this.rest), false);
  }

  private key(event: KeyboardEvent): void {
    const { histogram } = this;
    const point = this.points[this.chosen];
    if (!histogram || !point) return;
    const span = (histogram.max - histogram.min) / (event.shiftKey ? 20 : 200);
    const acts: Record<string, () => void> = {
      ArrowLeft: () => this.edit({ at: point.at - span }),
      ArrowRight: () => this.edit({ at: point.at + span }),
      ArrowUp: () => this.edit({ opacity: point.opacity + (event.shiftKey ? 0.1 : 0.01) }),
      ArrowDown: () => this.edit({ opacity: point.opacity - (event.shiftKey ? 0.1 : 0.01) }),
      PageDown: () => this.choose(this.chosen + 1),
      PageUp: () => this.choose(this.chosen - 1),
      Delete: () => this.remove(),
      Insert: () => this.add(),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
    this.place.querySelector<SVGElement>(".tf-point.chosen")?.focus();
  }

  private choose(at: number): void {
    this.chosen = Math.min(this.points.length - 1, Math.max(0, at));
    this.draw();
  }

  // --- drawing -----------------------------------------------------------------------------------------------------

  /** The values from left to right: the volume's, and the points'. */
  private get span(): { min: number; max: number } {
    const { min, max } = this.histogram as Histogram;
    const values = this.points.map((point) => point.at);
    return { min: Math.min(min, ...values), max: Math.max(max, ...values) };
  }

  private x(at: number): number {
    const { min, max } = this.span;
    return edge + ((at - min) / (max - min || 1)) * (this.width - 2 * edge);
  }

  private y(opacity: number): number {
    return edge + (1 - opacity) * (tall - 2 * edge);
  }

  private from_event(event: MouseEvent): { at: number; opacity: number } {
    const { min, max } = this.span;
    const box = (this.place.firstElementChild as Element).getBoundingClientRect();
    return { at: min + ((event.clientX - box.left - edge) / (this.width - 2 * edge)) * (max - min), opacity: 1 - (event.clientY - box.top - edge) / (tall - 2 * edge) };
  }

  private svg: SVGElement | null = null;

  private draw(): void {
    this.width = this.place.clientWidth;
    if (!this.histogram || this.width < 50) return;
    if (!this.svg) {
      this.svg = s("svg", { height: tall, width: "100%", role: "group", "aria-label": "Points of the transfer function" });
      this.svg.addEventListener("keydown", (event) => this.key(event));
      this.svg.addEventListener("dblclick", (event) => {
        const { at, opacity } = this.from_event(event);
        const { min, max } = this.span;
        if (at >= min && at <= max) this.add(at, Math.min(1, Math.max(0, opacity)));
      });
      this.svg.addEventListener("pointerdown", (event) => this.grasp(event));
      this.place.append(this.svg);
    }
    const { bins } = this.histogram;
    const { min, max } = this.span;
    const most = Math.log1p(Math.max(...bins));
    const left = this.x(this.histogram.min), wide = (this.x(this.histogram.max) - left) / bins.length;
    const bars = bins.map((count, i) => {
      const high = (Math.log1p(count) / most) * (tall - 2 * edge);
      return count ? `M${(left + i * wide).toFixed(1)} ${tall - edge}v${(-high).toFixed(1)}h${wide.toFixed(2)}v${high.toFixed(1)}z` : "";
    });
    const stops = this.points.map((point) => s("stop", { offset: (point.at - min) / (max - min || 1), "stop-color": hex_of(point.colour) }));
    const curve = this.points.map((point) => `${this.x(point.at).toFixed(1)},${this.y(point.opacity).toFixed(1)}`);
    const first = this.points[0], last = this.points[this.points.length - 1];
    this.svg.replaceChildren(
      s("defs", {}, s("linearGradient", { id: "tf-stops" }, stops)),
      s("rect", { x: edge, y: tall - 8, width: this.width - 2 * edge, height: 8, fill: "url(#tf-stops)" }),
      s("path", { class: "tf-bars", d: bars.join("") }),
      ...(first ? [s("polyline", { class: "tf-curve", points: [`${edge},${this.y(first.opacity)}`, ...curve, `${this.width - edge},${this.y(last.opacity)}`].join(" ") })] : []),
      ...this.points.map((point, i) =>
        s("circle", {
          class: i === this.chosen ? "tf-point chosen" : "tf-point",
          "data-point": i,
          cx: this.x(point.at),
          cy: this.y(point.opacity),
          r: 7,
          fill: hex_of(point.colour),
          tabindex: i === this.chosen ? 0 : -1,
          role: "slider",
          "aria-label": `Point ${i + 1} of ${this.points.length}`,
          "aria-valuemin": min,
          "aria-valuemax": max,
          "aria-valuenow": point.at,
          "aria-valuetext": `value ${number_text(point.at)}, opacity ${number_text(point.opacity)}`,
        }),
      ),
    );
    const point = this.points[this.chosen];
    if (!point) return;
    for (const [field, text] of [[this.at, String(Number(point.at.toPrecision(6)))], [this.opacity, String(Number(point.opacity.toPrecision(4)))], [this.colour, hex_of(point.colour)]] as const) if (field !== document.activeElement || field.type === "color") field.value = text;
  }

  private grasp(event: PointerEvent): void {
    const found = (event.target as Element).getAttribute("data-point");
    if (found === null || event.button !== 0 || !this.svg) return;
    this.choose(Number(found));
    const { svg } = this;
    svg.setPointerCapture(event.pointerId);
    const move = (moved: PointerEvent): void => this.edit(this.from_event(moved), true);
    const end = (): void => {
      svg.removeEventListener("pointermove", move);
      this.changed(toml_of(this.points, this.rest), false);
      svg.querySelector<SVGElement>(".tf-point.chosen")?.focus();
    };
    svg.addEventListener("pointermove", move);
    svg.addEventListener("pointerup", end, { once: true });
    event.preventDefault();
  }
}
