// SPDX-License-Identifier: Apache-2.0
// A section whose answer takes long: a button asks for it, and a change of the state makes it stale.
import { clear, h } from "../../../report/web/src/dom";
import type { Result } from "../../../report/web/src/page";

export abstract class Asked {
  readonly root: HTMLElement;
  private readonly body = h("div");
  private readonly button: HTMLButtonElement;

  constructor(
    id: string,
    title: string,
    question: string,
    /** What the answer will be. */
    private readonly about: string,
    ask: () => void,
  ) {
    this.button = h("button", { type: "button", id: `ask-${id}`, click: ask }, question);
    this.root = h("section", { class: "box", id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), this.button, this.body);
    this.stale();
  }

  stale(): void {
    this.button.disabled = false;
    this.body.replaceChildren(h("p", { class: "note" }, this.about));
  }

  wait(): void {
    this.button.disabled = true;
  }

  fail(message: string): void {
    this.button.disabled = false;
    this.body.replaceChildren(h("p", { class: "wrong-line", role: "alert" }, message));
  }

  show(answer: Result): void {
    this.button.disabled = false;
    clear(this.body);
    this.fill(this.body, answer);
  }

  protected abstract fill(body: HTMLElement, answer: Result): void;
}
