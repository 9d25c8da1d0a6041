// SPDX-License-Identifier: Apache-2.0
// A worker with a queue: of each channel only the newest request counts. Restarts a worker that died or was cancelled.
import type { Answer, Request } from "./answers";
import type { FromWorker, ToWorker } from "./worker";

/** Rejects a request that a newer one of its channel replaced, or that was cancelled. */
export class Dropped extends Error {
  constructor(readonly cancelled: boolean) {
    super(cancelled ? "cancelled" : "replaced by a newer request");
  }
}

interface Job {
  id: number;
  channel: string;
  request: Request;
  done: (answer: Answer) => void;
  fail: (error: Error) => void;
}

export interface Program {
  module: WebAssembly.Module;
  /** Address of the worker's script. */
  script: string;
}

/** Files that every worker gets, by name. */
export type Files = Map<string, Blob>;

export class Engine {
  /** Null until something is asked. */
  private worker: Worker | null = null;
  private waiting: Job[] = [];
  private running: Job | null = null;
  private next = 1;
  private ready = false;
  private begun = 0;
  /** Starts that failed in a row: an engine that cannot start is not started for ever. */
  private failed_starts = 0;

  constructor(
    private readonly program: Program,
    private readonly files: Files,
    /** Called with one sentence when the worker died and was started again. */
    private readonly died: (message: string) => void,
  ) {}

  private start(): Worker {
    const worker = new Worker(this.program.script);
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => worker === this.worker && this.take(data);
    worker.onerror = (event) => {
      event.preventDefault();
      if (worker === this.worker) this.dead(event.message || "the worker stopped");
    };
    this.ready = false;
    this.send({ kind: "start", module: this.program.module }, worker);
    for (const [name, blob] of this.files) this.send({ kind: "file", name, blob }, worker);
    return worker;
  }

  private send(message: ToWorker, worker = this.worker): void {
    worker?.postMessage(message);
  }

  /** Gives a file to the worker; later workers get it too. */
  add_file(name: string, blob: Blob): void {
    this.send({ kind: "file", name, blob });
  }

  remove_file(name: string): void {
    this.send({ kind: "remove", name });
  }

  /** Milliseconds since the running request began; 0 if none runs. */
  get busy_for(): number {
    return this.running ? performance.now() - this.begun : 0;
  }

  get busy_with(): Request | null {
    return this.running?.request ?? null;
  }

  /** Asks; a waiting request of the same channel is dropped. */
  ask<T>(channel: string, request: Request): Promise<Answer<T>> {
    this.worker ??= this.start();
    this.waiting = this.waiting.filter((job) => {
      if (job.channel === channel) job.fail(new Dropped(false));
      return job.channel !== channel;
    });
    return new Promise((done, fail) => {
      this.waiting.push({ id: this.next++, channel, request, done: done as (answer: Answer) => void, fail });
      this.go();
    });
  }

  private go(): void {
    if (!this.ready || this.running) return;
    const job = this.waiting.shift() ?? null;
    this.running = job;
    this.begun = performance.now();
    if (job) this.send({ kind: "ask", id: job.id, request: job.request });
  }

  private take(data: FromWorker): void {
    if (data.kind === "ready") {
      this.ready = true;
      this.failed_starts = 0;
      return this.go();
    }
    if (data.kind === "failed" && data.dead) return this.dead(data.message);
    const job = this.running;
    if (!job || job.id !== data.id) return;
    this.running = null;
    if (data.kind === "failed") {
      job.fail(new Error(data.message));
    } else {
      const { pictures: heads = [], ...json } = JSON.parse(data.json);
      const pictures = heads.map((head: Answer["pictures"][0]["head"], i: number) => ({ head, words: data.words[i] }));
      if (json.error) job.fail(new Error(json.error));
      else job.done({ json, pictures, ms: data.ms });
    }
    this.go();
  }

  private dead(message: string): void {
    this.worker?.terminate();
    const job = this.running;
    this.running = null;
    if (!this.ready && ++this.failed_starts >= 3) {
      for (const each of [job, ...this.waiting]) each?.fail(new Error(`the engine does not start: ${message}`));
      this.waiting = [];
      this.died(`The engine does not start: ${message}`);
      return;
    }
    this.worker = this.start();
    job?.fail(new Error(`the engine stopped: ${message}`));
    this.died(`The engine stopped (${message}) and was started again.`);
  }

  /** Stops what runs and what waits; the worker starts anew. */
  cancel(): void {
    const jobs = [this.running, ...this.waiting];
    this.worker?.terminate();
    this.running = null;
    this.waiting = [];
    this.worker = this.start();
    for (const job of jobs) job?.fail(new Dropped(true));
  }
}
