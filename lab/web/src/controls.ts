// SPDX-License-Identifier: Apache-2.0
// One control per setting or key: label, slider with a number field, choice or text, reset, and a line for a message.
import { h } from "../../../report/web/src/dom";
import type { Range } from "./ranges";

export interface Spec {
  name: string;
  label: string;
  /** Shown below the control, and read with it. */
  help: string;
  default: string;
  kind: { choices: [value: string, text: string][] } | { range: Range } | { text: string };
}

/** Called with the new value, or null for the default. `live`: the slider is still being dragged. */
export type Changed = (name: string, value: string | null, live: boolean) => void;

export interface Control {
  root: HTMLElement;
  /** Shows a value; null: the default. */
  show(value: string | null): void;
  /** Disables the control and says why; "" enables it. */
  disable(reason: string): void;
  /** Shows the engine's complaint; "" removes it. */
  complain(message: string): void;
  /** Another default: that of another configuration. */
  set_default(value: string): void;
}

let count = 0;

export function control(spec: Spec, changed: Changed): Control {
  const id = `control-${++count}`;
  let standard = spec.default;
  let value: string | null = null;
  let reason = "";
  const message = h("span", { class: "why", id: `${id}-why`, hidden: true });
  const help = h("span", { class: "help", id: `${id}-help` }, spec.help);
  const describe = { "aria-describedby": `${id}-help ${id}-why` };
  const set = (next: string, live: boolean): void => changed(spec.name, same(next, standard) ? null : next, live);
  const reset = h("button", { type: "button", class: "reset", title: "Back to the default", "aria-label": `Reset ${spec.label}`, hidden: true, click: () => changed(spec.name, null, false) }, "\u21ba");
  const inputs: (HTMLInputElement | HTMLSelectElement)[] = [];
  let write: (text: string) => void;

  if ("choices" in spec.kind) {
    const select = h("select", { id, ...describe, change: () => set(select.value, false) }, spec.kind.choices.map(([key, text]) => h("option", { value: key }, text)));
    inputs.push(select);
    write = (text) => (select.value = text);
  } else if ("range" in spec.kind) {
    const { range } = spec.kind;
    const slider = h("input", { type: "range", "aria-label": spec.label, min: 0, max: range.steps, step: 1, ...describe });
    const field = h("input", { type: "number", id, min: range.low, max: range.high, step: "any", ...describe });
    slider.addEventListener("input", () => {
      field.value = range.text(range.value(Number(slider.value)));
      slider.setAttribute("aria-valuetext", field.value);
      set(field.value, true);
    });
    slider.addEventListener("change", () => set(field.value, false));
    // Arrows in the field move by the slider's steps: by powers of two where only these are valid.
    field.addEventListener("keydown", (event) => {
      const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      const at = Math.min(range.steps, Math.max(0, range.position(Number(field.value)) + step));
      field.value = range.text(range.value(at));
      set(field.value, false);
    });
    field.addEventListener("change", () => field.value.trim() !== "" && set(field.value.trim(), false));
    inputs.push(slider, field);
    write = (text) => {
      field.value = text;
      slider.value = String(range.position(Number(text)));
      slider.setAttribute("aria-valuetext", text);
    };
  } else {
    const field = h("input", { type: "text", id, placeholder: spec.kind.text, spellcheck: "false", ...describe, change: () => set(field.value.trim(), false) });
    inputs.push(field);
    write = (text) => (field.value = text);
  }

  const root = h("div", { class: "control", "data-name": spec.name }, h("label", { for: id, title: spec.name }, spec.label), h("div", { class: "entry" }, inputs, reset), help, message);
  const result: Control = {
    root,
    show: (next) => {
      value = next;
      const text = next ?? standard;
      // The field that is typed in keeps its text, unless another value is shown.
      if (!inputs.some((input) => input === document.activeElement && same(input.value, text))) write(text);
      root.classList.toggle("changed", next !== null);
      reset.hidden = next === null;
    },
    disable: (why) => {
      if (why === reason) return;
      reason = why;
      for (const input of inputs) input.disabled = why !== "";
      root.classList.toggle("idle", why !== "");
      message.textContent = why;
      message.hidden = why === "";
    },
    complain: (text) => {
      root.classList.toggle("wrong", text !== "");
      for (const input of inputs) input.setAttribute("aria-invalid", String(text !== ""));
      if (reason) return;
      message.textContent = text;
      message.hidden = text === "";
    },
    set_default: (next) => {
      standard = next;
      result.show(value);
    },
  };
  result.show(null);
  return result;
}

/** "1.0" and "1" are the same value. */
export function same(a: string, b: string): boolean {
  return a === b || (a.trim() !== "" && b.trim() !== "" && Number(a) === Number(b));
}
