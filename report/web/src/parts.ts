// SPDX-License-Identifier: Apache-2.0
// Elements shared by panels: verdict sentence, key figures.
import { h, type Child } from "./dom";

const words: Record<string, string> = { pass: "\u2713 Pass", fail: "\u2717 Fail", error: "\u2717 Error", none: "Measured" };

/** The main sentence, after the verdict if there is one. */
export function lead(status: string | null, ...sentence: Child[]): HTMLElement {
  return h("p", { class: "lead" }, status !== null && h("span", { class: `mark ${status}` }, words[status] ?? status), ...sentence);
}

/** Key figures side by side; those without a value are omitted. */
export function tiles(...entries: ([name: string, ...value: Child[]] | null | false)[]): HTMLElement {
  return h(
    "dl",
    { class: "tiles" },
    entries.map((entry) => {
      const value = entry ? h("dd", {}, entry.slice(1) as Child[]) : null;
      const figures = [...(value?.querySelectorAll(".figure") ?? [])];
      return entry && !(figures.length && figures.every((each) => each.textContent === "\u2013")) && h("div", {}, h("dt", {}, entry[0]), value);
    }),
  );
}

export function note(...what: Child[]): HTMLElement {
  return h("p", { class: "note" }, ...what);
}

export function grid(root: HTMLElement): HTMLElement {
  const element = h("div", { class: "grid" });
  root.append(element);
  return element;
}

/** A cell of `grid`; outside of a grid, a separate part. */
export function cell(parent: HTMLElement): HTMLElement {
  const element = h("div", { class: parent.classList.contains("grid") ? null : "solo" });
  parent.append(element);
  return element;
}

/** What "cost" counts. */
export const cost_unit = "full adders";

/** Scene and configuration, as the result names them, with the configuration's hash. */
export function made_of(result: { scene?: unknown; config?: unknown; config_hash?: unknown }): string {
  const scene = typeof result.scene === "string" ? result.scene : "";
  const config = result.config as { name?: string; hash?: string } | string | undefined;
  const name = typeof config === "string" ? config : config?.name;
  const hash = typeof config === "string" ? result.config_hash : config?.hash;
  return [scene, name ? `configuration ${name} ${hash ?? ""}`.trim() : ""].filter(Boolean).join("; ");
}
