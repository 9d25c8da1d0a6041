// SPDX-License-Identifier: Apache-2.0
// SVG drawings that are redrawn when the width of their place changes; CSS colours them by theme.
import { clear, h, s } from "./dom";
import { tick_text } from "./figures";
import type { Scale } from "./scales";

export interface Drawing {
  svg: SVGElement;
  width: number;
  /** Sets the height; call once, in `draw`. */
  height(pixels: number): void;
  /** Shows `text` while the pointer is on `element`; if `focusable`, also by keyboard: Tab, then arrows. */
  tip(element: SVGElement, text: string, focusable?: boolean): void;
}

/** A figure in `root`: caption and drawing. `label` describes it for screen readers. */
export function drawing(
  root: HTMLElement,
  options: { title: string; about?: string; label: string },
  draw: (to: Drawing) => void,
): HTMLElement {
  const place = h("div", { class: "chart" });
  const bubble = h("div", { class: "tip", role: "tooltip" });
  const frame = h(
    "figure",
    {},
    h("figcaption", {}, h("strong", {}, options.title), options.about ? ` ${options.about}` : null),
    place,
  );
  root.append(frame);

  const show = (element: SVGElement, text: string): void => {
    const box = element.getBoundingClientRect();
    const host = place.getBoundingClientRect();
    bubble.textContent = text;
    bubble.style.display = "block";
    const left = Math.min(box.left + box.width / 2 - host.left + 8, host.width - bubble.offsetWidth);
    bubble.style.left = `${Math.max(0, left)}px`;
    const above = box.top - host.top - bubble.offsetHeight - 4;
    bubble.style.top = `${above > -30 ? above : box.bottom - host.top + 4}px`;
  };
  const hide = (): void => {
    bubble.style.display = "none";
  };

  let drawn = -1;
  const again = (): void => {
    const width = Math.floor(place.clientWidth);
    if (width === drawn || width <= 0) return;
    drawn = width;
    clear(place);
    const svg = s("svg", { role: "group", "aria-label": options.label, width: "100%" });
    place.append(svg, bubble);
    // One Tab stop per drawing; arrows move within it.
    const stops: SVGElement[] = [];
    svg.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
      const from = stops.indexOf(event.target as SVGElement);
      const next = step === undefined || from < 0 ? undefined : stops[from + step];
      if (!next) return;
      event.preventDefault();
      stops[from].setAttribute("tabindex", "-1");
      next.setAttribute("tabindex", "0");
      next.focus();
    });
    draw({
      svg,
      width,
      height: (pixels) => {
        svg.setAttribute("viewBox", `0 0 ${width} ${pixels}`);
        svg.setAttribute("height", String(pixels));
      },
      tip: (element, text, focusable = false) => {
        element.addEventListener("pointerenter", () => show(element, text));
        element.addEventListener("pointerleave", hide);
        element.append(s("title", {}, text));
        if (!focusable) return;
        element.setAttribute("tabindex", stops.length ? "-1" : "0");
        stops.push(element);
        element.setAttribute("role", "img");
        element.setAttribute("aria-label", text);
        element.addEventListener("focus", () => show(element, text));
        element.addEventListener("blur", hide);
      },
    });
  };
  again();
  new ResizeObserver(again).observe(place);
  return frame;
}

export function text(x: number, y: number, words: string, attributes: Record<string, string | number> = {}): SVGElement {
  return s("text", { x, y, ...attributes }, words);
}

export function rectangle(x: number, y: number, width: number, height: number, colour: string, rest: Record<string, string | number> = {}): SVGElement {
  return s("rect", { x, y, width: Math.max(0, width), height: Math.max(0, height), fill: `var(--${colour})`, ...rest });
}

export function line(x1: number, y1: number, x2: number, y2: number, rest: Record<string, string | number> = {}): SVGElement {
  return s("line", { x1, y1, x2, y2, ...rest });
}

/** Approximate width of text, enough to reserve room for it. */
export function text_width(words: string, size = 12): number {
  return words.length * size * 0.6;
}

/** Ticks and grid lines of a horizontal axis under `bottom`; omits labels that would touch. */
export function axis_below(to: Drawing, scale: Scale, top: number, bottom: number, name = "", format: (value: number) => string = tick_text): void {
  let free = -Infinity;
  for (const value of scale.ticks) {
    const x = scale(value);
    to.svg.append(line(x, top, x, bottom, { class: "gridline" }));
    const label = format(value);
    const half = text_width(label, 11) / 2;
    if (x - half < free || x - half < -12 || x + half > to.width + 12) continue;
    free = x + half + 8;
    to.svg.append(text(x, bottom + 15, label, { class: "tick", "text-anchor": "middle" }));
  }
  if (name) to.svg.append(text(to.width, bottom + 31, name, { class: "tick", "text-anchor": "end" }));
}

/** Ticks and grid lines of a vertical axis left of `left`. */
export function axis_left(to: Drawing, scale: Scale, left: number, right: number, format: (value: number) => string = tick_text): void {
  for (const value of scale.ticks) {
    const y = scale(value);
    to.svg.append(
      line(left, y, right, y, { class: "gridline" }),
      text(left - 6, y + 4, format(value), { class: "tick", "text-anchor": "end" }),
    );
  }
}

/** A legend under a drawing. */
export function legend(entries: { name: string; colour: string }[]): HTMLElement {
  return h(
    "ul",
    { class: "legend" },
    entries.map(({ name, colour }) => h("li", {}, h("span", { class: "key", style: `--key:var(--${colour})` }), name)),
  );
}
