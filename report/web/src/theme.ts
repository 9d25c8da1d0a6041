// Light or dark: as the system says, until the reader chooses. Print is always light.
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

/** Called after the colours have changed: canvases must be drawn again, SVG follows by itself. */
export function on_theme(listener: () => void): void {
  listeners.add(listener);
}

/** The value of a colour of report.css, for canvases: colour("c0"). */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/** Colours of series; after the last the first comes again, so marks and dashes must differ too. */
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
