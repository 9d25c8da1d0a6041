// SPDX-License-Identifier: Apache-2.0
// The line above the pictures: an error or a notice, and what the engine works on, with a button that stops it.
import { h } from "../../../report/web/src/dom";
import type { Engine } from "./engine";

/** Work that takes longer is shown. */
const patience_ms = 1000;

const names: Record<string, string> = { frame: "the pictures", cycles: "the cycles", errors: "the error by step", terminated: "the terminated pixels", pixel: "the pixel's story", histogram: "the histogram", config: "the configuration", tables: "the tables", link: "the link" };

export class Status {
  readonly root = h("div", { class: "status" });
  private readonly error = h("p", { class: "wrong-line", id: "error", role: "alert", hidden: true });
  private readonly notice = h("p", { class: "notice", id: "notice", role: "status", hidden: true });
  private readonly lines: { engine: Engine; root: HTMLElement; text: HTMLElement }[] = [];

  constructor(engines: Engine[], cancel: (engine: Engine) => void) {
    for (const engine of engines) {
      const text = h("span");
      const root = h("p", { class: "working", hidden: true }, text, h("button", { type: "button", class: "cancel", click: () => cancel(engine) }, "Cancel"));
      this.lines.push({ engine, root, text });
    }
    this.root.append(this.error, this.notice, ...this.lines.map((line) => line.root));
    setInterval(() => this.tick(), 200);
  }

  private tick(): void {
    for (const { engine, root, text } of this.lines) {
      const ms = engine.busy_for;
      root.hidden = ms < patience_ms;
      if (!root.hidden) text.textContent = `Working on ${names[engine.busy_with?.ask ?? ""]}\u2026 ${Math.floor(ms / 1000)} s `;
    }
  }

  show_error(message: string): void {
    this.error.textContent = message;
    this.error.hidden = message === "";
  }

  show_notice(message: string): void {
    this.notice.replaceChildren(message, " ", h("button", { type: "button", "aria-label": "Hide this notice", click: () => (this.notice.hidden = true) }, "Hide"));
    this.notice.hidden = message === "";
  }
}
