// SPDX-License-Identifier: Apache-2.0
// The viewer's state, and links that restore it.

export type Mode = "side" | "slider" | "flicker";

export interface State {
  mode: Mode;
  group: number;
  /** Views side by side, by key. */
  show: string[];
  /** Picture ids: reference and test of the error, left and right of the slider. */
  a: string;
  b: string;
  channel: "colour" | "0" | "1" | "2" | "3";
  /** Screen pixels per picture pixel; 0: fit the whole picture. */
  zoom: number;
  /** Centre of the visible part, in pixels of the whole frame. */
  x: number;
  y: number;
  /** The pixel whose words are shown; null: none. */
  at: { x: number; y: number } | null;
  /** Position of the slider between the pictures, 0..1. */
  split: number;
}

const prefix = "#pictures?";

/** "#pictures?mode=side&a=...": everything that affects the view. */
export function link_of(state: State): string {
  const words = new URLSearchParams({ mode: state.mode, group: String(state.group), show: state.show.join(","), a: state.a, b: state.b, channel: state.channel });
  if (state.zoom > 0) {
    words.set("zoom", String(+state.zoom.toFixed(3)));
    words.set("centre", `${+state.x.toFixed(2)},${+state.y.toFixed(2)}`);
  }
  if (state.at) words.set("at", `${state.at.x},${state.at.y}`);
  if (state.mode === "slider") words.set("split", state.split.toFixed(3));
  return prefix + words.toString().replaceAll("%2C", ",");
}

function pair(text: string | null): { x: number; y: number } | null {
  const numbers = (text ?? "").split(",").map(Number);
  return numbers.length === 2 && numbers.every(Number.isFinite) ? { x: numbers[0], y: numbers[1] } : null;
}

/** Where links are kept. */
export interface Address {
  read(): string;
  write(link: string, state: State): void;
}

/** The page's own address. */
export const page_address: Address = {
  read: () => location.hash,
  write: (link) => history.replaceState(null, "", link),
};

/** `state` with the link's values; missing or invalid ones keep their value. */
export function from_link(hash: string, state: State): State | null {
  if (!hash.startsWith(prefix)) return null;
  const words = new URLSearchParams(hash.slice(prefix.length));
  const next = { ...state };
  const mode = words.get("mode");
  if (mode === "side" || mode === "slider" || mode === "flicker") next.mode = mode;
  const group = Number(words.get("group"));
  if (Number.isInteger(group)) next.group = group;
  if (words.get("show")) next.show = (words.get("show") ?? "").split(",");
  next.a = words.get("a") ?? state.a;
  next.b = words.get("b") ?? state.b;
  const channel = words.get("channel");
  if (channel === "colour" || (channel && /^[0-3]$/.test(channel))) next.channel = channel as State["channel"];
  const at = pair(words.get("at"));
  if (at) next.at = { x: Math.floor(at.x), y: Math.floor(at.y) };
  const zoom = Number(words.get("zoom"));
  const centre = pair(words.get("centre")) ?? (at ? { x: at.x + 0.5, y: at.y + 0.5 } : null);
  if (zoom > 0 && centre) Object.assign(next, { zoom, x: centre.x, y: centre.y });
  else if (!words.has("zoom")) next.zoom = 0;
  const split = Number(words.get("split") ?? Number.NaN);
  if (split >= 0 && split <= 1) next.split = split;
  return next;
}
