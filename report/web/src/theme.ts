// SPDX-License-Identifier: Apache-2.0
// Light or dark theme: the system's until the reader chooses. Print is always light.
import { h } from "./dom";

const dark = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<() => void>();
let chosen: "light" | "dark" | null = null;

function apply(): void {
  const theme = chosen ?? (dark.matches ? "dark" : "light");
  if (document.documentElement.dataset.theme === theme) return;
  document.documentElement.dataset.theme = theme;
  for (const listener of listeners) listener();
}

/** Calls `listener` after a change of colours: canvases must be redrawn, SVG follows by itself. */
export function on_theme(listener: () => void): void {
  listeners.add(listener);
}

/** A colour of report.css, for canvases: colour("c0"). */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Colours of series. They repeat after the last, so series must also differ in mark or dash. */
export const series_colours = ["c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"];

export function start_theme(): void {
  dark.addEventListener("change", apply);
  addEventListener("beforeprint", () => {
    document.documentElement.dataset.theme = "light";
    for (const listener of listeners) listener();
  });
  addEventListener("afterprint", apply);
  apply();
}

export function theme_button(): HTMLElement {
  const name = (): string => (document.documentElement.dataset.theme === "dark" ? "Light" : "Dark");
  const button = h(
    "button",
    {
      type: "button",
      click: () => {
        chosen = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
        apply();
      },
    },
    name(),
  );
  const label = (): void => button.setAttribute("aria-label", `${name()} colours`);
  label();
  on_theme(() => {
    button.textContent = name();
    label();
  });
  return button;
}
