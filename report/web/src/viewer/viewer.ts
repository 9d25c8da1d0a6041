// SPDX-License-Identifier: Apache-2.0
// The viewer: pictures of one scene side by side, split by a slider, or alternating; zoom and pan are shared.
import { copy, h, say, type Child } from "../dom";
import { colour, on_theme } from "../theme";
import type { Channel } from "./plane";
import { error_colour, round_range } from "./derived";
import { readout } from "./readout";
import { from_link, link_of, page_address, type Address, type Mode, type State } from "./state";
import { begin, camera, draw, mark } from "./surface";
import type { Scene, View } from "./views";

/** A place of interest from a compare's result. */
export interface Place {
  label: Child;
  x: number;
  y: number;
}

export interface Tour {
  lsb_bits: number;
  worst: Place | null;
  clusters: Place[];
  /** Text shown without clusters. */
  none: string;
}

type Point = { x: number; y: number };
const most_zoom = 96;

export class Viewer {
  private readonly panes = h("div", { class: "panes" });
  private readonly words = h("div", { class: "words" });
  private readonly controls = h("div");
  private readonly jumps = h("div", { class: "jumps" });
  /** Values and jumps: at the lower edge of the window while a pane is visible. */
  private readonly dock = h("div", { class: "dock" }, this.jumps, this.words);
  private readonly legend = h("div", { class: "controls error-legend" });
  private surfaces: { canvas: HTMLCanvasElement; views: () => View[] }[] = [];
  /** The pane that was pointed at or used last; jumps scroll to it. */
  private used = 0;
  private hover: Point | null = null;
  private range = 0;
  private phase = 0;
  private cluster = -1;
  private waiting = false;
  private linking = 0;
  /** The chosen pixel's place, 0..1 of the frame: kept while pictures of other sizes come and go. */
  private chosen: Point | null = null;
  /** The views that a reader or a link chose: kept while a picture is missing. Null: none chosen. */
  private wished: Pick<State, "a" | "b" | "show"> | null = null;
  private state: State;

  constructor(
    root: HTMLElement,
    private scenes: { name: string; scene: Scene }[],
    private readonly tour: (scene: Scene, a: string, b: string) => Tour,
    private readonly address: Address = page_address,
  ) {
    this.state = this.fresh(0);
    const linked = from_link(address.read(), this.state);
    if (linked) this.follow(linked);
    this.choose();
    root.classList.add("viewer");
    root.append(this.controls, h("div", {}, this.panes, this.dock));
    root.addEventListener("keydown", (event) => this.key(event));
    on_theme(() => this.redraw());
    new ResizeObserver(() => this.redraw()).observe(this.panes);
    // Panes fill the height that the dock leaves.
    new ResizeObserver(() => root.style.setProperty("--dock", `${this.dock.offsetHeight}px`)).observe(this.dock);
    addEventListener("hashchange", () => {
      const next = from_link(this.address.read(), this.state);
      if (!next) return;
      this.follow(next);
      this.choose();
      this.build();
      this.reveal();
    });
    setInterval(() => this.turn(), 600);
    this.build();
    if (linked) requestAnimationFrame(() => requestAnimationFrame(() => this.reveal()));
  }

  /** Shows other pictures. State stays: the same part of the frame and the same pixel, also in another size. */
  replace(scenes: { name: string; scene: Scene }[]): void {
    const { scene: before } = this;
    const shape = (of: Scene): string => [...of.planes.map((plane) => `${plane.picture.id} ${plane.picture.title} ${plane.top_word}`)].join();
    const first = scenes[Math.min(this.state.group, scenes.length - 1)].scene;
    const grown = first.width / before.width;
    // Sizes that were rounded differ a little in shape.
    const same = scenes.length === this.scenes.length && shape(first) === shape(before) && Math.abs((first.width * before.height) / (first.height * before.width) - 1) < 0.03;
    const at = this.chosen && { x: Math.floor(this.chosen.x * first.width), y: Math.floor(this.chosen.y * first.height) };
    this.scenes = scenes;
    this.hover = null;
    this.state = this.legal({ ...this.state, ...(this.wished ?? this.first_views(this.scene)), at, zoom: this.state.zoom / grown, x: this.state.x * grown, y: this.state.y * grown });
    if (!same) return this.build();
    this.refresh_notes();
    this.build_legend();
    this.build_jumps();
    this.redraw();
  }

  get link(): string {
    return link_of(this.state);
  }

  /** Adds a view to those side by side. */
  present(key: string): void {
    const show = this.state.show.includes(key) ? this.state.show : [...this.state.show, key];
    this.change({ mode: "side", show });
  }

  private follow(linked: State): void {
    const { a, b, show } = linked;
    this.wished = { a, b, show };
    this.state = this.legal(linked);
  }

  private choose(): void {
    const { at } = this.state;
    this.chosen = at && { x: (at.x + 0.5) / this.scene.width, y: (at.y + 0.5) / this.scene.height };
  }

  private get scene(): Scene {
    return this.scenes[this.state.group].scene;
  }

  private get lsb_bits(): number {
    return this.tour(this.scene, this.state.a, this.state.b).lsb_bits;
  }

  private fresh(group: number): State {
    return { mode: "side", group, ...this.first_views(this.scenes[group].scene), channel: "colour", zoom: 0, x: 0, y: 0, at: null, split: 0.5 };
  }

  private first_views(scene: Scene): Pick<State, "a" | "b" | "show"> {
    const measured = scene.measured.length > 0 ? scene.measured : scene.planes;
    const first = measured[0].picture.id;
    const [a, b] = scene.compared ?? [first, (measured.find((plane) => scene.pair(first, plane.picture.id)) ?? measured[measured.length - 1]).picture.id];
    const maps = scene.planes.filter((plane) => plane.picture.display).map((plane) => plane.picture.id);
    const show = [...new Set([a, b, ...(scene.pair(a, b) ? ["error"] : []), ...maps])].slice(0, 4);
    return { a, b, show };
  }

  /** Corrects a state, which may come from a link to another report: replaces what does not exist here. */
  private legal(state: State): State {
    const group = state.group >= 0 && state.group < this.scenes.length ? state.group : 0;
    const fresh = this.fresh(group), { scene } = this.scenes[group];
    const a = scene.plane(state.a) ? state.a : fresh.a, b = scene.plane(state.b) ? state.b : fresh.b;
    const show = state.show.filter((key) => scene.keys(a, b).includes(key));
    const at = state.at && state.at.x >= 0 && state.at.y >= 0 && state.at.x < scene.width && state.at.y < scene.height ? state.at : null;
    return { ...state, group, a, b, show: show.length ? show : fresh.show, at, zoom: Math.min(most_zoom, Math.max(0, state.zoom)) };
  }

  private view(key: string): View | null {
    const { a, b, channel } = this.state;
    return this.scene.view(key, a, b, channel, this.lsb_bits, this.range);
  }

  private change(part: Partial<State>, rebuild = true): void {
    this.state = this.legal({ ...this.state, ...part });
    if ("at" in part) this.choose();
    if (part.a || part.b || part.show) this.wished = { a: this.state.a, b: this.state.b, show: this.state.show };
    if (rebuild) this.build();
    else this.redraw();
    clearTimeout(this.linking);
    this.linking = window.setTimeout(() => this.address.write(link_of(this.state), this.state), 200);
  }

  // --- elements --------------------------------------------------------------------------------------------------

  private build(): void {
    this.build_controls();
    this.build_panes();
    this.build_legend();
    this.build_jumps();
    this.redraw();
  }

  private choice(label: string, options: [string, string][], value: string, choose: (value: string) => void): HTMLElement {
    const select = h("select", { "aria-label": label, change: () => choose(select.value) }, options.map(([key, text]) => h("option", { value: key, selected: key === value }, text)));
    return h("label", {}, label, select);
  }

  private build_controls(): void {
    const { state, scene } = this;
    const focused = this.controls.contains(document.activeElement) ? document.activeElement?.getAttribute("data-key") : null;
    const pictures = scene.planes.map((plane): [string, string] => [plane.picture.id, plane.picture.title]);
    const modes: [Mode, string][] = [["side", "Side by side"], ["slider", "Slider"], ["flicker", "Flicker"]];
    const button = (key: string, text: string, title: string, act: () => void, pressed?: boolean): HTMLElement =>
      h("button", { type: "button", "data-key": key, title, "aria-pressed": pressed === undefined ? null : String(pressed), click: act }, text);
    const show = scene.keys(state.a, state.b).map((key) =>
      button(`show-${key}`, this.view(key)?.title ?? key, "Shown side by side or not", () => {
        const keys = scene.keys(state.a, state.b).filter((each) => (each === key) !== state.show.includes(each));
        if (keys.length) this.change({ show: keys });
      }, state.show.includes(key)),
    );
    this.controls.replaceChildren(
      h(
        "div",
        { class: "controls" },
        this.scenes.length > 1 && this.choice("Scene", this.scenes.map(({ name }, i) => [String(i), name]), String(state.group), (value) => {
          this.state = this.fresh(Number(value));
          this.wished = null;
          this.change({});
        }),
        h("span", { class: "group", role: "group", "aria-label": "How pictures are shown" }, modes.map(([mode, text]) => button(`mode-${mode}`, text, "Key m", () => this.change({ mode }), mode === state.mode))),
        this.choice("Reference", pictures, state.a, (a) => this.change({ a })),
        this.choice("Test", pictures, state.b, (b) => this.change({ b })),
        this.choice("Channel", [["colour", "Colour"], ["0", "R"], ["1", "G"], ["2", "B"], ["3", "A"]], state.channel, (channel) => this.change({ channel: channel as Channel })),
        h(
          "span",
          { class: "group", role: "group", "aria-label": "Zoom" },
          button("out", "\u2212", "Smaller, key \u2212", () => this.zoom(0.5)),
          button("in", "+", "Larger, key +", () => this.zoom(2)),
          button("one", "1:1", "A picture's pixel on a screen's, key 1", () => this.zoom_to(1)),
          button("fit", "Fit", "The whole picture, key 0", () => this.change({ zoom: 0 }, false)),
          h("output", { class: "zoom" }),
        ),
      ),
      state.mode === "side"
        ? h("div", { class: "controls show", role: "group", "aria-label": "Pictures shown" }, show)
        : h("div", { class: "controls show" }, state.mode === "slider" ? this.slider() : h("span", { class: "note" }, "Space shows the other picture")),
    );
    if (focused) this.controls.querySelector<HTMLElement>(`[data-key="${focused}"]`)?.focus();
  }

  private slider(): HTMLElement {
    const input = h("input", { type: "range", min: 0, max: 1000, value: Math.round(this.state.split * 1000), class: "split", input: () => this.change({ split: Number(input.value) / 1000 }, false) });
    return h("label", { class: "split" }, "Reference left of", input);
  }

  private build_panes(): void {
    const { state, scene } = this;
    const focused = this.panes.contains(document.activeElement) ? document.activeElement?.getAttribute("data-view") : null;
    this.surfaces = [];
    this.used = 0;
    const pane = (key: string, title: string, views: () => View[], more: Child = null): HTMLElement => {
      const canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": `${title}. Arrow keys move the pixel that is read, plus and minus zoom`, "data-view": key });
      this.listen(canvas);
      this.surfaces.push({ canvas, views });
      return h("figure", { class: "pane" }, h("figcaption", {}, h("strong", {}, title)), h("div", { class: "frame", style: `aspect-ratio:${scene.width}/${scene.height};max-width:calc(var(--pane)*${scene.width / scene.height})` }, canvas), more);
    };
    const one = (key: string): View[] => [this.view(key)].filter((view) => view !== null);
    const both = (): View[] => [...one(state.a), ...one(state.b)];
    if (state.mode === "side") {
      this.panes.replaceChildren(
        ...state.show.map((key) => {
          const view = this.view(key);
          return pane(key, view?.title ?? key, () => one(key), [key === "error" && this.legend, view && this.strip(view), view?.note ? h("p", { class: "note", "data-note": key }, view.note) : null]);
        }),
      );
    } else {
      const [a, b] = both();
      const title = state.mode === "slider" ? `${a?.title} | ${b?.title}` : `${a?.title} and ${b?.title} in turn`;
      this.panes.replaceChildren(pane(state.mode, title, both));
    }
    if (focused) this.surfaces.find(({ canvas }) => canvas.dataset.view === focused)?.canvas.focus({ preventScroll: true });
    this.panes.dataset.mode = state.mode;
    this.panes.dataset.count = String(this.surfaces.length);
  }

  private refresh_notes(): void {
    for (const note of this.panes.querySelectorAll<HTMLElement>("[data-note]")) note.textContent = this.view(note.dataset.note ?? "")?.note ?? "";
  }

  /** A map's own legend, from below its picture. */
  private strip(view: View): HTMLElement | null {
    const from = Math.round(view.rows * view.factor), rows = view.image.height - from;
    if (rows <= 0) return null;
    const canvas = h("canvas", { class: "strip", role: "img", "aria-label": `Legend of ${view.title}`, width: view.image.width, height: rows });
    canvas.getContext("2d")?.drawImage(view.image, 0, -from);
    return canvas;
  }

  private build_legend(): void {
    const { a, b, channel, mode, show } = this.state;
    const d = mode === "side" && show.includes("error") ? this.scene.difference(a, b, channel, this.lsb_bits) : null;
    this.legend.hidden = !d;
    if (!d) return;
    const range = this.range > 0 ? this.range : round_range(d.max);
    const bar = h("canvas", { width: 200, height: 12, role: "img", "aria-label": `blue: test too dark by ${range} LSB, grey: equal, red: too bright by ${range} LSB` });
    const context = bar.getContext("2d");
    for (let x = 0; context && x < 200; ++x) {
      context.fillStyle = `rgb(${error_colour(((x - 99.5) / 99.5) * range, range).join(" ")})`;
      context.fillRect(x, 0, 1, 12);
    }
    const ranges: [string, string][] = [0, 0.25, 0.5, 1, 2, 4, 16, 64].map((r) => [String(r), r ? `\u00b1${r} LSB` : "automatic"]);
    this.legend.replaceChildren(
      h("span", { class: "ramp" }, `\u2212${range}`, bar, `+${range} LSB`),
      this.choice("Range", ranges, String(this.range), (value) => {
        this.range = Number(value);
        this.build();
      }),
      h("span", { class: "note" }, `signed error of the ${channel === "colour" ? "channel that errs most" : "channel"}, test \u2212 reference, LSB of ${this.lsb_bits} bits`),
    );
  }

  private build_jumps(): void {
    const { a, b } = this.state;
    const tour = this.tour(this.scene, a, b);
    const jump = (place: Place, more: object): HTMLElement => h("button", { type: "button", click: () => this.jump(place), ...more }, place.label);
    this.jumps.replaceChildren(
      h("span", { class: "note" }, "Jump to"),
      ...(tour.worst ? [jump(tour.worst, { title: "Key w", "data-jump": "worst" })] : []),
      ...tour.clusters.map((place, i) => jump(place, { title: "Key c: the next one", "data-jump": `cluster-${i}` })),
      ...(tour.clusters.length === 0 ? [h("span", { class: "note" }, tour.none)] : []),
      h("button", { type: "button", class: "copy", click: async () => {
        this.address.write(link_of(this.state), this.state);
        say((await copy(location.href)) ? "Link copied" : "The link is in the address bar");
      } }, "Copy link"),
    );
  }

  // --- drawing ---------------------------------------------------------------------------------------------------

  private redraw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.paint();
    });
  }

  private paint(): void {
    for (const { canvas, views } of this.surfaces) {
      const context = begin(canvas);
      if (!context) continue;
      const to = camera(canvas, this.scene, this.state);
      const [first, second] = views();
      if (this.state.mode === "slider" && second) this.paint_split(context, canvas, first, second, to);
      else if (this.state.mode === "flicker" && second) draw(context, this.phase ? second : first, to);
      else if (first) draw(context, first, to);
      if (this.state.mode === "flicker" && second) this.paint_name(context, this.phase ? second : first);
      if (this.state.at) mark(context, this.state.at, to);
      const output = this.controls.querySelector("output.zoom");
      if (output) output.textContent = `${+(to.scale * 100).toPrecision(3)} %`;
      canvas.dataset.scale = String(to.scale);
    }
    this.dock.hidden = this.scene.measured.length === 0;
    readout(this.words, this.scene, this.state.a, this.state.b, this.lsb_bits, this.hover ?? this.state.at);
  }

  private paint_split(context: CanvasRenderingContext2D, canvas: HTMLCanvasElement, first: View, second: View, to: { scale: number; left: number; top: number }): void {
    const x = Math.round(this.state.split * canvas.clientWidth);
    for (const [view, left, right] of [[first, 0, x], [second, x, canvas.clientWidth]] as const) {
      context.save();
      context.beginPath();
      context.rect(left, 0, right - left, canvas.clientHeight);
      context.clip();
      draw(context, view, to);
      context.restore();
    }
    context.fillStyle = "#000";
    context.fillRect(x - 2, 0, 4, canvas.clientHeight);
    context.fillStyle = "#fff";
    context.fillRect(x - 1, 0, 2, canvas.clientHeight);
  }

  private paint_name(context: CanvasRenderingContext2D, view: View): void {
    context.font = "14px system-ui, 'DejaVu Sans', sans-serif";
    const width = context.measureText(view.title).width + 16;
    context.fillStyle = colour("paper");
    context.fillRect(6, 6, width, 24);
    context.fillStyle = colour("ink");
    context.fillText(view.title, 14, 23);
  }

  /** Alternates two pictures every 0.6 s, below three flashes per second. With reduced motion only the space bar
   *  does. */
  private turn(): void {
    if (this.state.mode !== "flicker" || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    this.phase = 1 - this.phase;
    this.redraw();
  }

  // --- input -----------------------------------------------------------------------------------------------------

  private pixel(canvas: HTMLCanvasElement, event: MouseEvent): Point | null {
    const box = canvas.getBoundingClientRect(), to = camera(canvas, this.scene, this.state);
    const x = Math.floor((event.clientX - box.left - to.left) / to.scale), y = Math.floor((event.clientY - box.top - to.top) / to.scale);
    return x >= 0 && y >= 0 && x < this.scene.width && y < this.scene.height ? { x, y } : null;
  }

  private listen(canvas: HTMLCanvasElement): void {
    for (const kind of ["pointermove", "pointerdown", "focus"]) canvas.addEventListener(kind, () => (this.used = this.surfaces.findIndex((each) => each.canvas === canvas)));
    let start: { x: number; y: number; state: State; scale: number; split: boolean } | null = null;
    let moved = false;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const box = canvas.getBoundingClientRect(), to = camera(canvas, this.scene, this.state);
      const split = this.state.mode === "slider" && Math.abs(event.clientX - box.left - this.state.split * box.width) < 12;
      const centre = { x: (canvas.clientWidth / 2 - to.left) / to.scale, y: (canvas.clientHeight / 2 - to.top) / to.scale };
      start = { x: event.clientX, y: event.clientY, state: { ...this.state, zoom: to.scale, ...centre }, scale: to.scale, split };
      moved = false;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      const box = canvas.getBoundingClientRect();
      if (!start) {
        this.hover = this.pixel(canvas, event);
        this.redraw();
        return;
      }
      const dx = event.clientX - start.x, dy = event.clientY - start.y;
      moved ||= Math.hypot(dx, dy) > 3;
      if (!moved) return;
      if (start.split) {
        this.change({ split: Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)) }, false);
        const input = this.controls.querySelector<HTMLInputElement>("input.split");
        if (input) input.value = String(Math.round(this.state.split * 1000));
      } else {
        this.change({ zoom: start.scale, x: start.state.x - dx / start.scale, y: start.state.y - dy / start.scale }, false);
      }
    });
    canvas.addEventListener("pointerup", (event) => {
      if (start && !moved) this.change({ at: this.pixel(canvas, event) }, false);
      start = null;
    });
    canvas.addEventListener("pointercancel", () => (start = null));
    canvas.addEventListener("pointerleave", () => {
      this.hover = null;
      this.redraw();
    });
    canvas.addEventListener("wheel", (event) => {
      // The wheel scrolls the page until a picture has been selected.
      if (!event.ctrlKey && !event.metaKey && document.activeElement !== canvas) return;
      event.preventDefault();
      const box = canvas.getBoundingClientRect();
      this.zoom(2 ** (-Math.sign(event.deltaY) / 2), canvas, { x: event.clientX - box.left, y: event.clientY - box.top });
    }, { passive: false });
  }

  /** Zooms by the factor `by`; the frame's point under `about` (canvas pixels) stays in place. */
  private zoom(by: number, canvas = this.surfaces[0]?.canvas, about?: Point): void {
    if (!canvas) return;
    const to = camera(canvas, this.scene, this.state);
    const centre = { x: canvas.clientWidth / 2, y: canvas.clientHeight / 2 }, hold = about ?? centre;
    const x = (hold.x - to.left) / to.scale, y = (hold.y - to.top) / to.scale;
    const scale = Math.min(most_zoom, Math.max(1 / 16, to.scale * by));
    this.change({ zoom: scale, x: x + (centre.x - hold.x) / scale, y: y + (centre.y - hold.y) / scale }, false);
  }

  private zoom_to(scale: number): void {
    const canvas = this.surfaces[0]?.canvas;
    if (canvas) this.zoom(scale / camera(canvas, this.scene, this.state).scale);
  }

  private jump(place: Point): void {
    this.change({ at: { x: place.x, y: place.y }, zoom: Math.max(12, this.state.zoom), x: place.x + 0.5, y: place.y + 0.5 }, false);
    this.reveal();
    say(`Pixel ${place.x}, ${place.y}`);
  }

  /** Scrolls the pane that was used last fully into view, between the page's contents and the dock, unless some pane
   *  is fully visible. */
  private reveal(): void {
    const top = (document.getElementById("contents")?.offsetHeight ?? 0) + 4, bottom = innerHeight - this.dock.offsetHeight - 4;
    const frames = this.surfaces.map(({ canvas }) => (canvas.closest(".pane")?.querySelector(".frame") ?? canvas).getBoundingClientRect());
    if (frames.some((frame) => frame.top >= top && frame.bottom <= bottom)) return;
    const frame = frames[this.used] ?? frames[0];
    // Includes the title above the picture if there is room.
    if (frame) scrollBy({ top: frame.top - Math.max(top, Math.min(top + 28, bottom - frame.height)), behavior: "instant" });
  }

  private move(dx: number, dy: number): void {
    const from = this.state.at ?? { x: Math.floor(this.scene.width / 2), y: Math.floor(this.scene.height / 2) };
    const at = { x: Math.min(this.scene.width - 1, Math.max(0, from.x + dx)), y: Math.min(this.scene.height - 1, Math.max(0, from.y + dy)) };
    const canvas = this.surfaces[0]?.canvas;
    const part: Partial<State> = { at };
    if (canvas && this.state.zoom > 0) {
      const to = camera(canvas, this.scene, this.state);
      const sx = (at.x + 0.5) * to.scale + to.left, sy = (at.y + 0.5) * to.scale + to.top;
      // Centres the pixel when it leaves the pane.
      if (sx < 0 || sy < 0 || sx > canvas.clientWidth || sy > canvas.clientHeight) Object.assign(part, { x: at.x + 0.5, y: at.y + 0.5 });
    }
    this.change(part, false);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.target instanceof HTMLCanvasElement)) return;
    const step = event.shiftKey ? 10 : 1;
    const tour = this.tour(this.scene, this.state.a, this.state.b);
    const modes: Mode[] = ["side", "slider", "flicker"];
    const acts: Record<string, () => void> = {
      ArrowLeft: () => this.move(-step, 0),
      ArrowRight: () => this.move(step, 0),
      ArrowUp: () => this.move(0, -step),
      ArrowDown: () => this.move(0, step),
      "+": () => this.zoom(2),
      "=": () => this.zoom(2),
      "-": () => this.zoom(0.5),
      "0": () => this.change({ zoom: 0 }, false),
      "1": () => this.zoom_to(1),
      m: () => {
        this.change({ mode: modes[(modes.indexOf(this.state.mode) + 1) % modes.length] });
        this.surfaces[0]?.canvas.focus();
      },
      "[": () => this.change({ split: Math.max(0, this.state.split - 0.02) }, false),
      "]": () => this.change({ split: Math.min(1, this.state.split + 0.02) }, false),
      " ": () => {
        this.phase = 1 - this.phase;
        this.redraw();
      },
      w: () => tour.worst && this.jump(tour.worst),
      c: () => {
        if (!tour.clusters.length) return say(tour.none);
        this.cluster = (this.cluster + 1) % tour.clusters.length;
        this.jump(tour.clusters[this.cluster]);
      },
      Escape: () => this.change({ at: null }, false),
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
