// SPDX-License-Identifier: Apache-2.0
// What takes longer than a picture, on a worker of its own so that sliders stay quick: cycles, error by step, terminated
// pixels, a pixel's story, the volume's histogram.
import type { Result } from "../../../report/web/src/page";
import type { Answer, Histogram, Request, Story, Tables } from "./answers";
import type { Asked } from "./asked";
import { BlamePart } from "./blame";
import { CyclesPart, type Cycles } from "./cycles";
import type { Shown } from "./drawer";
import { Dropped, type Engine } from "./engine";
import { save } from "./files";
import type { Lab, Store } from "./lab_state";
import { PixelStory } from "./pixel_story";
import { request_of, tf_key } from "./requests";
import { TerminatedPart } from "./terminated";
import { TfEditor } from "./tf_editor";

/** Time at rest before anything is asked for. */
const rest_ms = 400;

export interface Found {
  /** A map of the frame: of the steps that err, or of terminated pixels. */
  map(picture: Answer["pictures"][0]): void;
  /** Cycles of a state's configuration. */
  cycles(lab: Lab, hash: string, actual: number): void;
}

export class SlowWork {
  readonly cycles = new CyclesPart();
  readonly blame: Asked = new BlamePart(() => void this.ask_map("errors", this.blame));
  readonly terminated: Asked = new TerminatedPart(() => void this.ask_map("terminated", this.terminated));
  readonly story = new PixelStory(() => void this.ask_pixel());
  readonly tf: TfEditor;
  private at: { x: number; y: number } | null = null;
  private shown: Shown | null = null;
  private timer = 0;
  /** Volume and function that the editor shows. */
  private edited = "";

  constructor(
    private readonly tables: Tables,
    private readonly slow: Engine,
    private readonly store: Store,
    /** Gives the engines the files that a state needs. */
    private readonly prepare: (lab: Lab) => void,
    private readonly found: Found,
  ) {
    this.tf = new TfEditor(
      () => void this.ask_histogram(),
      (toml, live) => {
        this.edited = tf_key({ ...store.now, tf_toml: toml });
        store.set({ tf_toml: toml }, "tf", live);
      },
      (toml) => save("tf.toml", toml),
    );
  }

  /** After a change of the state: what runs is of no use any more. */
  changed(): void {
    clearTimeout(this.timer);
    if (["errors", "terminated"].includes(this.slow.busy_with?.ask ?? "")) this.slow.cancel();
  }

  /** After a frame. */
  show(shown: Shown): void {
    this.shown = shown;
    this.blame.stale();
    this.terminated.stale();
    clearTimeout(this.timer);
    if (shown.draft) return;
    this.cycles.wait();
    this.timer = window.setTimeout(() => {
      void this.ask_cycles(shown);
      void this.ask_pixel();
      void this.ask_histogram();
    }, rest_ms);
  }

  /** The pixel that was chosen in a picture. */
  choose(at: { x: number; y: number } | null): void {
    const moved = JSON.stringify(at) !== JSON.stringify(this.at);
    this.at = at;
    if (moved) void this.ask_pixel();
  }

  /** Asks the engine for slow work; null if the answer is not wanted any more. */
  private async slowly<T>(ask: Request["ask"], lab: Lab, more: Partial<Request> = {}): Promise<{ json: T; pictures: Shown["pictures"] } | null> {
    this.prepare(lab);
    try {
      return await this.slow.ask<T>(ask, { ...request_of(this.tables, lab, ask), ...more });
    } catch (error) {
      if (error instanceof Dropped && !error.cancelled) return null;
      throw error;
    }
  }

  private async ask_cycles({ lab, frame }: Shown): Promise<void> {
    try {
      const answer = await this.slowly<Cycles>("cycles", lab);
      if (!answer || lab !== this.store.now) return;
      this.cycles.show(answer.json);
      this.found.cycles(lab, frame.config.hash, answer.json.actual);
    } catch (error) {
      if (lab === this.store.now) this.cycles.fail((error as Error).message);
    }
  }

  private async ask_map(ask: "errors" | "terminated", part: Asked): Promise<void> {
    const lab = this.store.now;
    part.wait();
    try {
      const answer = await this.slowly<Result>(ask, lab);
      if (!answer) return;
      if (lab !== this.store.now) return part.stale();
      part.show(answer.json);
      this.found.map(answer.pictures[0]);
    } catch (error) {
      if (error instanceof Dropped) part.stale();
      else part.fail((error as Error).message);
    }
  }

  private async ask_pixel(): Promise<void> {
    const lab = this.store.now;
    if (!this.story.open || !this.shown || this.shown.draft || this.shown.lab !== lab) return;
    if (!this.at) return this.story.wait("Click a pixel of a picture.");
    const { x, y } = this.at;
    this.story.wait();
    try {
      const answer = await this.slowly<Story>("pixel", lab, { x, y });
      if (answer && lab === this.store.now) this.story.show(answer.json);
    } catch (error) {
      this.story.fail((error as Error).message);
    }
  }

  edit_tf(): void {
    this.tf.root.open = true;
    this.tf.root.scrollIntoView({ behavior: "instant", block: "nearest" });
    this.tf.root.querySelector("summary")?.focus();
  }

  private async ask_histogram(): Promise<void> {
    const lab = this.store.now;
    const of = tf_key(lab);
    if (!this.tf.open || of === this.edited) return;
    try {
      const answer = await this.slowly<Histogram>("histogram", lab);
      if (!answer || of !== tf_key(this.store.now)) return;
      this.edited = of;
      this.tf.show({ ...answer.json, toml: answer.json.toml ?? (lab.tf_toml || undefined) });
    } catch (error) {
      this.tf.fail((error as Error).message);
    }
  }
}
