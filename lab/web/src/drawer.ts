// SPDX-License-Identifier: Apache-2.0
// Asks for frames: small ones while a control is moved, the size asked for at rest.
import type { Answer, Frame, Request, Tables } from "./answers";
import { Dropped, type Engine } from "./engine";
import type { Lab, Store } from "./lab_state";
import { reduced, request_of } from "./requests";

export const draft_side = 128;
/** A change that is not followed by another one for so long is at rest. */
const rest_ms = 250;
/** A frame at rest that a change has made useless, and that has run for so long, is stopped. */
const useless_ms = 4000;
/** Frames that took longer are preceded by a draft. */
const slow_ms = 250;

export interface Shown {
  lab: Lab;
  frame: Frame;
  pictures: Answer["pictures"];
  /** Drawn smaller than asked for; another frame follows. */
  draft: boolean;
  /** From the request to the answer, and in the engine. */
  ms: number;
  engine_ms: number;
}

export class Drawer {
  private timer = 0;
  /** Time of the last frame at rest; before the first one, unknown. */
  private last_ms = Infinity;
  private last = 0;
  /** The state that was drawn at rest last, or is being drawn. */
  private resting: Lab | null = null;
  private rest_request: Request | null = null;
  /** The state of which a draft was asked last. */
  private drafted: Lab | null = null;

  constructor(
    private readonly engine: Engine,
    private readonly tables: Tables,
    private readonly store: Store,
    /** Called before a state is drawn. */
    private readonly prepare: (lab: Lab) => void,
    private readonly shown: (shown: Shown) => void,
    /** One line about the state's first error. `cancelled`: by the user. */
    private readonly failed: (message: string, cancelled: boolean) => void,
  ) {}

  draw(live: boolean): void {
    clearTimeout(this.timer);
    const lab = this.store.now;
    const small = reduced(lab, draft_side);
    const reducible = small.width < lab.width || small.height < lab.height;
    const turn = ++this.last;
    // A slider that is released repeats its last value, which is drawn once.
    if (lab === this.resting) return;
    this.resting = null;
    if (this.rest_request && this.engine.busy_with === this.rest_request && this.engine.busy_for > useless_ms) this.engine.cancel();
    if (reducible && lab !== this.drafted && (live || this.last_ms > slow_ms)) {
      this.drafted = lab;
      void this.ask(lab, true, turn);
    }
    if (!live || !reducible) void this.rest(lab, turn);
    else this.timer = window.setTimeout(() => this.draw(false), rest_ms);
  }

  private async rest(lab: Lab, turn: number): Promise<void> {
    this.resting = lab;
    if (!(await this.ask(lab, false, turn)) && this.resting === lab) this.resting = null;
  }

  private async ask(lab: Lab, draft: boolean, turn: number): Promise<boolean> {
    const begun = performance.now();
    this.prepare(lab);
    try {
      const size = draft ? reduced(lab, draft_side) : lab;
      const request = { ...request_of(this.tables, lab, "frame", size), quick: draft };
      if (!draft) this.rest_request = request;
      const { json, pictures, ms } = await this.engine.ask<Frame>("frame", request);
      if (!draft) this.last_ms = ms;
      this.shown({ lab, frame: json, pictures, draft, ms: performance.now() - begun, engine_ms: ms });
      return true;
    } catch (error) {
      if (error instanceof Dropped && !error.cancelled) return false;
      if (turn === this.last) this.failed((error as Error).message, error instanceof Dropped);
      return false;
    }
  }
}
