// SPDX-License-Identifier: Apache-2.0
// The page: puts its parts together and leads changes from one to the other.
import { copy, h, say } from "../../../report/web/src/dom";
import { theme_button } from "../../../report/web/src/theme";
import type { Config, Tables } from "./answers";
import { DevicePanel } from "./device_panel";
import { Drawer, type Shown } from "./drawer";
import { Dropped, type Engine } from "./engine";
import { listen_for_files, save, taken } from "./files";
import { Store, type Lab } from "./lab_state";
import { hash_of_link, link_of, link_request, state_of, view_of_link } from "./link";
import { Measures } from "./measures";
import { Panes } from "./panes";
import { device_key, request_of } from "./requests";
import { ScenePanel } from "./scene_panel";
import type { Shelf } from "./shelf";
import { SlowWork } from "./slow_work";
import { Status } from "./status";
import { name_of, shown_name, subject_of, to_subject, word_of } from "./subject";
import { Tabs } from "./tabs";
import { Tried } from "./tried";
import { Turn } from "./turn";

const keys = [
  "Click a picture: its pixel is read. w: the worst pixel, c: the next cluster, Esc: none.",
  "Drag a picture, or arrow keys: the camera turns. Shift + wheel, or + and \u2212: it zooms.",
  "t: dragging and keys move the view of the picture instead. Wheel: zooms it. 0: the whole picture.",
  "m: side by side, slider or flicker. [ and ]: the slider. Space: the other picture.",
  "Ctrl + Z and Ctrl + Shift + Z: undo and redo.",
];

export class Page {
  private readonly store: Store;
  private readonly drawer: Drawer;
  private readonly status: Status;
  private readonly panes: Panes;
  private readonly measures = new Measures();
  private readonly tried = new Tried((lab) => this.store.set({ config: lab.config, toml: lab.toml, changes: lab.changes }));
  private readonly slowly: SlowWork;
  private readonly scene: ScenePanel;
  private readonly device: DevicePanel;
  private readonly tabs: Tabs;
  private readonly command = h("pre", { id: "command", tabindex: 0 });
  private readonly undo = h("button", { type: "button", id: "undo", title: "Ctrl+Z", click: () => this.store.undo() }, "Undo");
  private readonly redo = h("button", { type: "button", id: "redo", title: "Ctrl+Shift+Z", click: () => this.store.redo() }, "Redo");
  private readonly open: () => void;
  /** The viewer's link before there is a viewer. */
  private readonly view: string;
  private linking = 0;
  /** Hash of the configuration that the first address names. */
  private wanted_hash: string;
  private base_of = "";
  private frames = 0;
  /** The state now, once it is shown at rest. */
  private drawn: Lab | null = null;

  constructor(
    private readonly tables: Tables,
    first: Lab,
    private readonly quick: Engine,
    slow: Engine,
    private readonly shelf: Shelf,
  ) {
    this.store = new Store(first);
    this.wanted_hash = hash_of_link(location.hash);
    this.view = view_of_link(location.hash);
    this.open = listen_for_files((list) => void this.take(list));
    this.status = new Status([quick, slow], (engine) => engine.cancel());
    this.panes = new Panes({
      read: () => view_of_link(location.hash) || this.view,
      write: (_view, state) => {
        this.address();
        this.slowly.choose(state.at);
      },
    });
    this.slowly = new SlowWork(tables, slow, this.store, (lab) => this.shelf.prepare(lab), {
      map: (picture) => this.panes.show_map(picture),
      cycles: (lab, hash, actual) => this.tried.add_cycles(lab, hash, actual),
    });
    this.scene = new ScenePanel(tables, this.store, () => this.slowly.edit_tf(), this.open);
    this.device = new DevicePanel(tables, this.store, { save: () => void this.save_config(), paste: (text) => void this.use_config(text) });
    this.tabs = new Tabs([
      { id: "scene", title: "Scene", panel: this.scene.root },
      { id: "device", title: "Device", panel: this.device.root },
    ]);
    this.drawer = new Drawer(quick, tables, this.store, (lab) => this.shelf.prepare(lab), (shown) => this.show(shown), (message, cancelled) => this.fail(message, cancelled));
    this.lay_out();
    this.store.on((_lab, { live }) => this.changed(live));
    addEventListener("hashchange", () => void this.follow());
    addEventListener("keydown", (event) => this.key(event));
  }

  private lay_out(): void {
    const defaults = Object.fromEntries(this.tables.settings.map((setting) => [setting.name, setting.default]));
    const turn = new Turn(this.panes.root, this.store, defaults);
    document.getElementById("top")?.append(
      h(
        "div",
        { class: "line" },
        h("h1", {}, "FastSplat lab"),
        h("span", { class: "buttons" }, turn.button, this.undo, this.redo, h("button", { type: "button", id: "copy-link", click: () => void this.copy_link() }, "Copy link"), theme_button()),
      ),
    );
    document.getElementById("lab")?.replaceChildren(
      h("section", { class: "pictures", id: "pictures", tabindex: -1, "aria-label": "Pictures" }, this.status.root, this.panes.root, h("details", { class: "keys" }, h("summary", {}, "Mouse and keys"), h("ul", {}, keys.map((line) => h("li", {}, line))))),
      h("div", { class: "side" }, this.tabs.root),
      h(
        "div",
        { class: "rest" },
        this.measures.root,
        h("div", { class: "pair" }, this.slowly.cycles.root, this.tried.root),
        this.slowly.story.root,
        this.slowly.tf.root,
        this.slowly.blame.root,
        this.slowly.terminated.root,
        h("section", { class: "box", "aria-labelledby": "command-title" }, h("h2", { id: "command-title" }, "The same picture by the program"), this.command, h("button", { type: "button", id: "copy-command", click: async () => say((await copy(this.command.textContent ?? "")) ? "Command copied" : "The browser does not let this page copy") }, "Copy the command")),
      ),
    );
    document.getElementById("foot")?.append(h("p", {}, `fastsplat ${this.tables.version}. The device runs in this page, bit for bit; nothing leaves it. Drop a volume (NIfTI, NRRD, MetaImage), 3-D Gaussians (.ply, .splat, .spz, .glb, .ksplat), a transfer function or a configuration (TOML) anywhere.`));
  }

  begin(): void {
    this.history();
    this.drawer.draw(false);
    void this.load_base();
  }

  notice(message: string): void {
    this.status.show_notice(message);
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  private changed(live: boolean): void {
    const lab = this.store.now;
    this.scene.show(lab);
    this.device.show(lab);
    this.history();
    // A slider that was held still is released: all is shown, or asked for.
    if (lab === this.drawn) return;
    this.drawn = null;
    this.slowly.changed();
    document.documentElement.dataset.settled = "false";
    this.drawer.draw(live);
    void this.load_base();
    clearTimeout(this.linking);
    this.linking = window.setTimeout(() => this.address(), 200);
  }

  private history(): void {
    const { settings, changes } = this.store.now;
    this.tabs.count("scene", Object.keys(settings).length);
    this.tabs.count("device", Object.keys(changes).length);
    this.undo.disabled = !this.store.can_undo;
    this.redo.disabled = !this.store.can_redo;
  }

  private address(): void {
    history.replaceState(null, "", link_of(this.store.now, this.panes.link || this.view));
  }

  private async follow(): Promise<void> {
    const request = link_request(location.hash);
    if (!request.link) return;
    try {
      const { lab, notice } = state_of((await this.quick.ask<Lab>("link", request)).json);
      this.store.set(lab);
      if (notice) this.notice(notice);
    } catch (error) {
      if (!(error instanceof Dropped)) this.status.show_error((error as Error).message);
    }
  }

  private async copy_link(): Promise<void> {
    this.address();
    say((await copy(location.href)) ? "Link copied" : "The link is in the address bar");
  }

  private key(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    const { target } = event;
    if (target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type === "text")) return;
    event.preventDefault();
    if (event.shiftKey) this.store.redo();
    else this.store.undo();
  }

  // --- frames --------------------------------------------------------------------------------------------------------

  private show(shown: Shown): void {
    const { frame, pictures, draft } = shown;
    this.status.show_error(frame.device_error ?? "");
    this.scene.show_error("");
    this.scene.show_idle(frame.idle);
    this.device.show_error("");
    this.device.show_file_error("");
    this.panes.show(frame, pictures);
    this.measures.show(shown);
    this.command.textContent = frame.command;
    document.title = `${shown_name(subject_of(shown.lab))}, ${frame.config.name}: FastSplat lab`;
    this.slowly.show(shown);
    if (!draft && shown.lab === this.store.now) this.drawn = shown.lab;
    const root = document.documentElement;
    Object.assign(root.dataset, { ready: "1", stale: "false", frames: String(++this.frames), settled: String(this.drawn !== null), ms: shown.ms.toFixed(1), engineMs: shown.engine_ms.toFixed(1), size: `${frame.width}x${frame.height}`, draft: String(draft), hash: frame.words_hash ?? "" });
    if (!draft) this.tried.add(shown);
    if (this.wanted_hash && this.wanted_hash !== frame.config.hash) this.notice(`The report's configuration ${frame.config.name} has the hash ${this.wanted_hash}; this one has ${frame.config.hash}. Set its changed keys, or drop its file.`);
    this.wanted_hash = "";
  }

  private fail(message: string, cancelled: boolean): void {
    document.documentElement.dataset.ready ??= "1";
    if (cancelled) return this.notice("Cancelled: the pictures and figures are those of an earlier state.");
    const subject = subject_of(this.store.now);
    const file = name_of(subject).startsWith("/files/") ? name_of(subject).slice("/files/".length) : "";
    if (file && !this.shelf.has(file)) return this.status.show_error(`This link shows the file ${shown_name(subject)}: drop it on the page.`);
    this.device.show_error(message);
    this.scene.show_error(message);
    this.status.show_error(message + (this.frames > 0 ? ". Pictures and figures are those of an earlier state." : ""));
    document.documentElement.dataset.stale = "true";
  }

  // --- configurations and files --------------------------------------------------------------------------------------

  /** Loads the values of the configuration without changes. */
  private async load_base(): Promise<void> {
    const lab = { ...this.store.now, changes: {} };
    const of = device_key(lab);
    if (of === this.base_of) return;
    this.base_of = of;
    try {
      const { json } = await this.quick.ask<Config>("config", request_of(this.tables, lab, "config"));
      if (of === this.base_of) this.device.show_base(json);
    } catch {
      this.base_of = ""; // the frame's error says it
    }
  }

  private async save_config(): Promise<void> {
    try {
      const { json } = await this.quick.ask<Config>("save", request_of(this.tables, this.store.now, "config"));
      save(`${json.name.replace(/[^A-Za-z0-9._-]/g, "_")}.toml`, json.toml ?? "");
    } catch (error) {
      this.device.show_file_error((error as Error).message);
    }
  }

  /** Takes a configuration if the engine reads it. False if it does not. */
  private async use_config(toml: string, take = true): Promise<boolean> {
    if (toml.trim() === "") return true;
    try {
      await this.quick.ask<Config>("use", request_of(this.tables, { ...this.store.now, toml, changes: {} }, "config"));
      if (take) this.store.set({ toml, changes: {} });
      return true;
    } catch (error) {
      if (error instanceof Dropped) return false;
      this.device.show_file_error((error as Error).message);
      this.status.show_error((error as Error).message);
      return false;
    }
  }

  private async take(list: File[]): Promise<void> {
    if (list.length === 0) return;
    let path = "";
    try {
      const { volumes, tf, config } = await taken(list, this.tables.limits.most_bytes);
      const alone = volumes.length === 0 && tf === null;
      if (config !== null && (!(await this.use_config(config, alone)) || alone)) return;
      if (volumes.length) path = this.shelf.add_volume(volumes);
      const subject = path ? word_of(path, volumes[0].kind === "gaussians") : subject_of(this.store.now);
      const next = { ...this.store.now, ...(tf === null ? {} : { tf_toml: tf }), ...to_subject(this.store.now, subject, this.tables), ...(config ? { toml: config, changes: {} } : {}) };
      this.shelf.prepare(next);
      if (path) this.notice(`Reading ${shown_name(subject)}\u2026`);
      // Tried before it is taken: a file that cannot be read leaves everything as it is.
      await this.quick.ask("file", request_of(this.tables, next, "frame", { width: 64, height: 64 }));
      const folder = path.slice(0, path.lastIndexOf("/") + 1);
      for (const { name, kind } of volumes) if (kind !== "data") this.scene.add_file(word_of(folder + name, kind === "gaussians"));
      this.store.set(next);
    } catch (error) {
      this.shelf.remove(path);
      if (!(error instanceof Dropped)) this.status.show_error((error as Error).message.replaceAll(/\/files\/(\d+\/)?/g, ""));
    } finally {
      if (path) this.notice("");
    }
  }
}
