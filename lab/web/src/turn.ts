// SPDX-License-Identifier: Apache-2.0
// Turns and zooms the camera by dragging a picture, by wheel and by keys, before the viewer sees the events.
import { h } from "../../../report/web/src/dom";
import type { Store } from "./lab_state";
import { changed } from "./lab_state";

const degrees_per_width = 180;
const step = 5; // degrees per key

function wrapped(degrees: number): number {
  return Math.round((((degrees + 180) % 360) + 360) % 360) - 180;
}

export class Turn {
  on = true;
  readonly button = h("button", { type: "button", "aria-pressed": "true", title: "Dragging and arrow keys turn the camera, not the view of the picture. Key t; Shift turns in any mode", click: () => this.toggle() }, "Turn by dragging");

  constructor(
    root: HTMLElement,
    private readonly store: Store,
    private readonly defaults: Record<string, string>,
  ) {
    for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"]) root.addEventListener(kind, (event) => this.pointer(event as PointerEvent), true);
    root.addEventListener("wheel", (event) => this.wheel(event), { capture: true, passive: false });
    root.addEventListener("keydown", (event) => this.key(event), true);
  }

  toggle(): void {
    this.on = !this.on;
    this.button.setAttribute("aria-pressed", String(this.on));
  }

  private value(name: string): number {
    return Number(this.store.now.settings[name] ?? this.defaults[name]);
  }

  private set(values: Record<string, number>, live: boolean): void {
    let { settings } = this.store.now;
    for (const [name, value] of Object.entries(values)) {
      const text = String(Number(value.toPrecision(6)));
      settings = changed(settings, name, Number(this.defaults[name]) === Number(text) ? null : text);
    }
    this.store.set({ settings }, "camera", live);
  }

  private start: { x: number; y: number; azimuth: number; elevation: number; moved: boolean } | null = null;

  private pointer(event: PointerEvent): void {
    const canvas = event.target;
    if (!(canvas instanceof HTMLCanvasElement) || canvas.classList.contains("strip")) return;
    const split = canvas.dataset.view === "slider";
    if (event.type === "pointerdown") {
      const wanted = event.shiftKey || (this.on && !split);
      this.start = wanted && event.button === 0 ? { x: event.clientX, y: event.clientY, azimuth: this.value("camera.azimuth"), elevation: this.value("camera.elevation"), moved: false } : null;
      return;
    }
    const { start } = this;
    if (!start) return;
    if (event.type === "pointermove") {
      event.stopPropagation();
      const dx = event.clientX - start.x, dy = event.clientY - start.y;
      start.moved ||= Math.hypot(dx, dy) > 3;
      if (!start.moved) return;
      const per = degrees_per_width / canvas.clientWidth;
      this.set({ "camera.azimuth": wrapped(start.azimuth - dx * per), "camera.elevation": Math.min(90, Math.max(-90, Math.round(start.elevation + dy * per))) }, true);
      return;
    }
    this.start = null;
    if (!start.moved) return; // a click chooses the pixel
    event.stopPropagation();
    canvas.dispatchEvent(new PointerEvent("pointercancel"));
    this.set({}, false);
  }

  private zoom(factor: number, live: boolean): void {
    this.set({ "camera.zoom": Math.min(1000, Math.max(0.01, this.value("camera.zoom") * factor)) }, live);
  }

  private wheel(event: WheelEvent): void {
    if (!event.shiftKey || !(event.target instanceof HTMLCanvasElement)) return;
    event.preventDefault();
    event.stopPropagation();
    const delta = event.deltaY || event.deltaX;
    if (delta) this.zoom(delta < 0 ? 1.1 : 1 / 1.1, true);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.target instanceof HTMLCanvasElement)) return;
    if (event.key === "t") this.toggle();
    else if (!this.on || !this.act(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  private act(event: KeyboardEvent): boolean {
    const by = event.shiftKey ? 1 : step;
    const turn = (azimuth: number, elevation: number): boolean => {
      this.set({ "camera.azimuth": wrapped(this.value("camera.azimuth") + azimuth), "camera.elevation": Math.min(90, Math.max(-90, this.value("camera.elevation") + elevation)) }, false);
      return true;
    };
    const zoom = (factor: number): boolean => {
      this.zoom(factor, false);
      return true;
    };
    const acts: Record<string, () => boolean> = {
      ArrowLeft: () => turn(by, 0),
      ArrowRight: () => turn(-by, 0),
      ArrowUp: () => turn(0, -by),
      ArrowDown: () => turn(0, by),
      "+": () => zoom(1.1),
      "=": () => zoom(1.1),
      "-": () => zoom(1 / 1.1),
    };
    return acts[event.key]?.() ?? false;
  }
}
