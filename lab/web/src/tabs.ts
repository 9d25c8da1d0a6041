// SPDX-License-Identifier: Apache-2.0
// Tabs: one of several panels is shown; arrow keys move between their names.
import { h } from "../../../report/web/src/dom";

export interface Tab {
  id: string;
  title: string;
  panel: HTMLElement;
}

export class Tabs {
  readonly root: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private readonly panels: HTMLElement[];

  constructor(private readonly tabs: Tab[]) {
    this.buttons = tabs.map(({ id, title }, i) =>
      h("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, click: () => this.show(i), keydown: (event: KeyboardEvent) => this.key(event, i) }, title),
    );
    this.panels = tabs.map(({ id, panel }) => h("div", { role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}` }, panel));
    this.root = h(
      "div",
      { class: "tabs" },
      h("div", { role: "tablist", "aria-label": "Controls" }, this.buttons),
      this.panels,
    );
    this.show(0);
  }

  private show(chosen: number): void {
    this.buttons.forEach((button, i) => {
      button.setAttribute("aria-selected", String(i === chosen));
      button.tabIndex = i === chosen ? 0 : -1;
      this.panels[i].hidden = i !== chosen;
    });
  }

  private key(event: KeyboardEvent, from: number): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const to = (from + step + this.tabs.length) % this.tabs.length;
    this.show(to);
    this.buttons[to].focus();
  }

  /** Shows a number beside a tab's name; 0: none. */
  count(id: string, changes: number): void {
    const i = this.tabs.findIndex((tab) => tab.id === id);
    const { title } = this.tabs[i];
    this.buttons[i].textContent = changes ? `${title} (${changes})` : title;
    this.buttons[i].title = changes ? `${changes} changed` : "";
  }
}
