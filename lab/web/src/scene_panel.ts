// SPDX-License-Identifier: Apache-2.0
// The scene's controls: volume, transfer function, kernel, size, and every setting of the engine's table by group.
import { h } from "../../../report/web/src/dom";
import type { Setting, Tables } from "./answers";
import { control, type Control, type Spec } from "./controls";
import { changed, type Lab, type Store } from "./lab_state";
import { integer_range, real_range } from "./ranges";
import { tf_file } from "./requests";
import { shown_name, subject_of, to_subject, word_of } from "./subject";

/** Settings that have a control of their own. */
const own = new Set(["image.width", "image.height", "camera.projection", "method"]);

/** Names that do not explain themselves. */
const better: Record<string, string> = { "camera.fov": "Field of view", "camera.fit": "Fit to", "culling.freeze": "Early termination", "kernel.a": "Kernel sharpness a", "raycast.end": "Ray end" };

function title_of(name: string): string {
  if (better[name]) return better[name];
  const words = name.replace(/^.*\./, "").replaceAll("_", " ");
  const group = name.includes(".") ? name.replace(/\..*$/, "").replaceAll("_", " ") : "";
  const plain = ["camera", "slabs", "xray"].includes(group) || group === "" ? (group === "camera" || group === "" ? words : `${group === "xray" ? "X-ray" : "slab"} ${words}`) : `${group} ${words}`;
  return plain[0].toUpperCase() + plain.slice(1);
}

function spec_of(setting: Setting): Spec {
  const spec = { name: setting.name, label: title_of(setting.name), help: setting.help, default: setting.default };
  if (setting.kind === "choice") return { ...spec, kind: { choices: (setting.choices ?? []).map((name) => [name, name.replaceAll("_", " ")]) } };
  const { low = 0, high = 1 } = setting;
  if (setting.kind === "real") return { ...spec, kind: { range: real_range(setting.name, low, high, Number(setting.default)) } };
  if (setting.kind === "integer") return { ...spec, kind: { range: integer_range(setting.name, low, high, false) } };
  return { ...spec, kind: { text: setting.unit || "text" } };
}

const group_of = (setting: Setting): string => setting.group || "Camera";

export class ScenePanel {
  readonly root: HTMLElement;
  private readonly controls = new Map<string, Control>();
  private readonly volume = h("select", { id: "volume", change: () => this.store.set(to_subject(this.store.now, this.volume.value, this.tables)) });
  private readonly tf = h("select", { id: "tf", change: () => this.choose_tf(this.tf.value) });
  private readonly kernel = h("select", { id: "kernel", change: () => this.store.set({ kernel: this.kernel.value }) });
  private readonly width = h("input", { type: "number", id: "width", step: 1, "aria-label": "Width in pixels", change: () => this.resize() });
  private readonly height = h("input", { type: "number", id: "height", step: 1, "aria-label": "Height in pixels", change: () => this.resize() });
  private readonly reset = h("button", { type: "button", id: "reset-scene", click: () => this.store.set({ settings: {} }) }, "Reset all settings");
  private readonly edit: HTMLButtonElement;
  /** Subjects from files. */
  private readonly files: string[] = [];
  private last_tf_toml = "";

  constructor(
    private readonly tables: Tables,
    private readonly store: Store,
    edit_tf: () => void,
    open_file: () => void,
  ) {
    const change = (name: string, value: string | null, live: boolean): void => store.set({ settings: changed(store.now.settings, name, value) }, `setting ${name}`, live);
    const made = (setting: Setting): HTMLElement => {
      const one = control(spec_of(setting), change);
      this.controls.set(setting.name, one);
      return one.root;
    };
    const named = (name: string): HTMLElement[] => tables.settings.filter((setting) => setting.name === name).map(made);
    const row = (label: string, id: string, ...inputs: HTMLElement[]): HTMLElement => h("div", { class: "control" }, h("label", { for: id }, label), h("div", { class: "entry" }, inputs));
    const groups = [...new Set(tables.settings.filter((setting) => !own.has(setting.name)).map(group_of))].sort((a, b) => Number(b === "Camera") - Number(a === "Camera"));
    this.edit = h("button", { type: "button", id: "edit-tf", click: edit_tf }, "Edit\u2026");
    for (const side of [this.width, this.height]) Object.assign(side, { min: tables.limits.least_side, max: tables.limits.most_side });
    this.fill_volumes();
    this.kernel.append(...tables.kernels.map((name) => h("option", { value: name }, name)));
    this.root = h(
      "section",
      { class: "box", id: "scene", "aria-labelledby": "scene-title" },
      h("h2", { id: "scene-title", class: "off" }, "Scene"),
      row("Volume or Gaussians", "volume", this.volume, h("button", { type: "button", title: "NIfTI, NRRD, MetaImage, .ply, .splat, .spz, .glb or .ksplat; or drop a file on the page", click: open_file }, "Open\u2026")),
      row("Transfer function", "tf", this.tf, this.edit),
      ...named("method"),
      ...named("camera.projection"),
      row("Kernel", "kernel", this.kernel),
      row("Size at rest", "width", this.width, h("span", { "aria-hidden": "true" }, "\u00d7"), this.height),
      this.reset,
      ...groups.map((group) => {
        const inside = tables.settings.filter((setting) => group_of(setting) === group && !own.has(setting.name));
        return h("details", { open: group === "Camera", "data-group": group }, h("summary", {}, group, h("span", { class: "count" })), inside.map(made));
      }),
    );
    this.show(store.now);
  }

  private fill_volumes(): void {
    const { volumes, gaussians } = this.tables;
    const sizes = (size: number): number[] => [...new Set([16, 32, 64, 128, size])].sort((a, b) => a - b);
    this.volume.replaceChildren(
      ...(this.files.length ? [h("optgroup", { label: "Files" }, this.files.map((path) => h("option", { value: path }, shown_name(path))))] : []),
      ...volumes.map(({ name, size }) => h("optgroup", { label: name }, sizes(size).map((n) => h("option", { value: `${name}:${n}` }, `${name}, ${n}\u00b3`)))),
      ...gaussians.map((name) => h("optgroup", { label: `${name}, 3-D Gaussians` }, [500, 2000, 10000, 50000].map((n) => h("option", { value: word_of(`${name}:${n}`, true) }, `${name}, ${n} Gaussians`)))),
    );
  }

  /** Offers a file that was dropped. */
  add_file(subject: string): void {
    if (!this.files.includes(subject)) this.files.push(subject);
    this.fill_volumes();
  }

  private choose_tf(value: string): void {
    if (value === "own") this.store.set({ tf_toml: this.last_tf_toml });
    else this.store.set({ tf: value, tf_toml: "" });
  }

  private resize(): void {
    const { least_side, most_side } = this.tables.limits;
    const side = (input: HTMLInputElement, now: number): number => Math.min(most_side, Math.max(least_side, Math.round(Number(input.value)) || now));
    this.store.set({ width: side(this.width, this.store.now.width), height: side(this.height, this.store.now.height) });
    this.show(this.store.now);
  }

  show(lab: Lab): void {
    const subject = subject_of(lab);
    if (![...this.volume.options].some((option) => option.value === subject)) this.volume.prepend(h("option", { value: subject }, shown_name(subject)));
    this.volume.value = subject;
    for (const one of [this.tf, this.kernel, this.edit]) one.disabled = lab.gaussians !== "";
    if (lab.tf_toml) this.last_tf_toml = lab.tf_toml;
    this.tf.replaceChildren(h("option", { value: "" }, "automatic"), ...this.tables.presets.map((name) => h("option", { value: name }, name)), ...(this.last_tf_toml ? [h("option", { value: "own" }, lab.tf_toml ? tf_file(lab) : "edited")] : []));
    this.tf.value = lab.tf_toml ? "own" : lab.tf;
    this.kernel.value = lab.kernel;
    if (document.activeElement !== this.width) this.width.value = String(lab.width);
    if (document.activeElement !== this.height) this.height.value = String(lab.height);
    this.reset.hidden = Object.keys(lab.settings).length === 0;
    for (const [name, one] of this.controls) one.show(lab.settings[name] ?? null);
    for (const details of this.root.querySelectorAll("details")) {
      const names = [...details.querySelectorAll<HTMLElement>("[data-name]")].map((each) => each.dataset.name ?? "");
      const set = names.filter((name) => name in lab.settings).length;
      const count = details.querySelector(".count");
      if (count) count.textContent = set ? ` ${set} changed` : "";
    }
  }

  /** Greys settings that have no effect, with the engine's reasons. */
  show_idle(idle: Record<string, string>): void {
    for (const [name, one] of this.controls) one.disable(idle[name] ?? "");
  }

  /** Shows an error at the setting that it names. */
  show_error(message: string): void {
    let placed = false;
    for (const [name, one] of this.controls) {
      const { flag } = this.tables.settings.find((setting) => setting.name === name) as Setting;
      const mine: boolean = !placed && message !== "" && (message.startsWith(`${name}:`) || (flag !== "" && new RegExp(`^${flag}[ :]`).test(message)));
      placed ||= mine;
      one.complain(mine ? message : "");
    }
  }
}
