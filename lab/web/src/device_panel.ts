// SPDX-License-Identifier: Apache-2.0
// The device's controls: a named configuration, each key with limits and meaning, and the list of what was changed.
import { h } from "../../../report/web/src/dom";
import type { Config, Key, Tables } from "./answers";
import { control, type Control, type Spec } from "./controls";
import { changed, type Lab, type Store } from "./lab_state";
import { integer_range } from "./ranges";

function spec_of(key: Key): Spec {
  const label = key.name.replace(/^.*\./, "").replaceAll("_", " ");
  const spec = { name: key.name, label, default: String(key.low) };
  if (key.names.length) return { ...spec, help: key.meaning, kind: { choices: key.names.map((name) => [name, name]) } };
  const limits = `${key.low}\u2013${key.high}${key.power_of_two ? ", a power of two" : ""}`;
  return { ...spec, help: `${key.meaning} (${limits})`, kind: { range: integer_range(key.name, key.low, key.high, key.power_of_two) } };
}

export interface DeviceActions {
  /** Saves the configuration as a file. */
  save(): void;
  /** Reads a configuration from a text. */
  paste(text: string): void;
}

export class DevicePanel {
  readonly root: HTMLElement;
  private readonly controls = new Map<string, Control>();
  private readonly config = h("select", { id: "config", change: () => this.choose(this.config.value) });
  private readonly list = h("ul", { class: "differences", id: "differences" });
  private readonly reset = h("button", { type: "button", id: "reset-device", click: () => this.store.set({ changes: {} }) }, "Reset all");
  private readonly error = h("p", { class: "wrong-line", role: "alert", hidden: true });
  private last_toml = "";
  /** Values of the configuration without changes. */
  private base: Config | null = null;

  constructor(
    private readonly tables: Tables,
    private readonly store: Store,
    actions: DeviceActions,
  ) {
    const change = (name: string, value: string | null, live: boolean): void => store.set({ changes: changed(store.now.changes, name, value) }, `key ${name}`, live);
    const groups = [...new Set(tables.keys.map((key) => key.name.replace(/\..*$/, "")))];
    const text = h("textarea", { id: "toml", rows: 4, spellcheck: "false", "aria-label": "Configuration as TOML", placeholder: "Paste a configuration here" });
    this.root = h(
      "section",
      { class: "box", id: "device", "aria-labelledby": "device-title" },
      h("h2", { id: "device-title", class: "off" }, "Device"),
      this.error,
      h("div", { class: "control" }, h("label", { for: "config" }, "Configuration"), h("div", { class: "entry" }, this.config, this.reset)),
      this.list,
      ...groups.map((group) => {
        const keys = tables.keys.filter((key) => key.name.startsWith(`${group}.`));
        const made = keys.map((key) => {
          const one = control(spec_of(key), change);
          this.controls.set(key.name, one);
          return one.root;
        });
        return h("details", { "data-group": group }, h("summary", {}, group, h("span", { class: "count" })), made);
      }),
      h(
        "details",
        { "data-group": "file" },
        h("summary", {}, "Configuration file"),
        h("div", { class: "entry" }, h("button", { type: "button", id: "save-toml", click: () => actions.save() }, "Save as TOML"), h("button", { type: "button", id: "use-toml", click: () => actions.paste(text.value) }, "Use the text below")),
        text,
      ),
    );
    this.show(store.now);
  }

  private choose(value: string): void {
    if (value === "own") this.store.set({ toml: this.last_toml, changes: {} });
    else this.store.set({ config: value, toml: "", changes: {} });
  }

  /** The values that "default" means: those of the configuration without changes. */
  show_base(base: Config): void {
    this.base = base;
    for (const [name, one] of this.controls) one.set_default(base.values[name]);
    this.show(this.store.now);
  }

  show(lab: Lab): void {
    if (lab.toml) this.last_toml = lab.toml;
    this.config.replaceChildren(...this.tables.configs.map(({ name }) => h("option", { value: name }, name)), ...(this.last_toml ? [h("option", { value: "own" }, "from a file")] : []));
    this.config.value = lab.toml ? "own" : lab.config;
    for (const [name, one] of this.controls) one.show(lab.changes[name] ?? null);
    const names = Object.keys(lab.changes);
    this.reset.hidden = names.length === 0;
    const about = lab.toml ? undefined : this.tables.configs.find((each) => each.name === lab.config)?.description;
    const from = lab.toml ? "the file" : lab.config;
    this.list.replaceChildren(
      ...(about ? [h("li", {}, about)] : []),
      h("li", { class: "note" }, names.length === 0 ? `The same as ${from}.` : `${names.length === 1 ? "1 key differs" : `${names.length} keys differ`} from ${from}:`),
      ...names.map((name) => h("li", {}, h("code", {}, `${name}: ${this.base?.values[name] ?? "?"} \u2192 ${lab.changes[name]}`))),
    );
    for (const details of this.root.querySelectorAll("details")) {
      const group = details.dataset.group ?? "";
      const set = names.filter((name) => name.startsWith(`${group}.`)).length;
      const count = details.querySelector(".count");
      if (count) count.textContent = set ? ` ${set} changed` : "";
    }
  }

  /** Shows an error of a configuration file. */
  show_file_error(message: string): void {
    this.error.hidden = message === "";
    this.error.textContent = message;
  }

  /** Shows an error at the key that it names, and opens the key's group. */
  show_error(message: string): void {
    let placed = false;
    for (const [name, one] of this.controls) {
      const mine: boolean = !placed && message !== "" && new RegExp(`(^|--set |[\\s'(])${name.replace(".", "\\.")}(=|:|\\s|,)`).test(message);
      placed ||= mine;
      one.complain(mine ? message : "");
      const details = one.root.closest("details");
      if (mine && details) details.open = true;
    }
  }
}
