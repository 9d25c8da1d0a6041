// SPDX-License-Identifier: Apache-2.0
// Draws part of the frame on a canvas; all surfaces share zoom and pan.
import { colour } from "../theme";
import type { View } from "./views";

/** Frame to screen: the top left corner of frame pixel (x, y) is at (x * scale + left, y * scale + top). */
export interface Camera {
  scale: number;
  left: number;
  top: number;
}

export function camera(canvas: HTMLCanvasElement, frame: { width: number; height: number }, state: { zoom: number; x: number; y: number }): Camera {
  const { clientWidth: w, clientHeight: hgt } = canvas;
  const scale = state.zoom > 0 ? state.zoom : Math.min(w / frame.width, hgt / frame.height) || 1;
  const x = state.zoom > 0 ? state.x : frame.width / 2, y = state.zoom > 0 ? state.y : frame.height / 2;
  return { scale, left: w / 2 - x * scale, top: hgt / 2 - y * scale };
}

/** Matches the canvas's pixels to its size on the screen. Returns null while it has no size. */
export function begin(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const ratio = devicePixelRatio || 1;
  const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
  if (!width || !height) return null;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const context = canvas.getContext("2d");
  if (!context) return null;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = colour("sheet");
  context.fillRect(0, 0, canvas.clientWidth, canvas.clientHeight);
  return context;
}

export function draw(context: CanvasRenderingContext2D, view: View, to: Camera): void {
  const { image, factor } = view;
  const rows = Math.min(image.height, Math.round(view.rows * factor));
  // Enlarged pixels stay squares; reduced ones are averaged.
  context.imageSmoothingEnabled = to.scale / factor < 1;
  context.imageSmoothingQuality = "high";
  context.drawImage(
    image, 0, 0, image.width, rows,
    to.left + view.x0 * to.scale, to.top + view.y0 * to.scale, (image.width / factor) * to.scale, (rows / factor) * to.scale,
  );
}

export function mark(context: CanvasRenderingContext2D, at: { x: number; y: number }, to: Camera): void {
  const side = Math.max(to.scale, 7), grow = (side - to.scale) / 2;
  const x = to.left + at.x * to.scale - grow, y = to.top + at.y * to.scale - grow;
  for (const [style, width] of [["#000", 3], ["#fff", 1]] as const) {
    context.strokeStyle = style;
    context.lineWidth = width;
    context.strokeRect(x - 1, y - 1, side + 2, side + 2);
  }
}
