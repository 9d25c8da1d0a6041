// SPDX-License-Identifier: Apache-2.0
// The worker: runs the engine, one request at a time. The engine's own script stands before this one in the same file.
import type { Request } from "./answers";

interface Module {
  FS: { mkdir(path: string): void; writeFile(path: string, bytes: Uint8Array): void; unlink(path: string): void; analyzePath(path: string): { exists: boolean } };
  HEAP32: Int32Array;
  _malloc(bytes: number): number;
  _free(at: number): void;
  _lab_answer(at: number): number;
  _lab_json(): number;
  _lab_words(picture: number): number;
  lengthBytesUTF8(text: string): number;
  stringToUTF8(text: string, at: number, bytes: number): void;
  UTF8ToString(at: number): string;
}

type Instantiate = (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => object;
declare const engine: (options: { instantiateWasm: Instantiate; print: (text: string) => void; printErr: (text: string) => void }) => Promise<Module>;

/** What the page sends: first the compiled engine, then files and requests. */
export type ToWorker = { kind: "start"; module: WebAssembly.Module } | { kind: "file"; name: string; blob: Blob } | { kind: "remove"; name: string } | { kind: "ask"; id: number; request: Request };
/** What it gets back. `dead`: the engine is in no state to go on. */
export type FromWorker =
  | { kind: "ready" }
  | { kind: "answer"; id: number; json: string; words: Int32Array[]; ms: number }
  | { kind: "failed"; id: number; message: string; dead: boolean };

interface Scope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer?: Transferable[]): void;
}
const scope = self as unknown as Scope;
let module: Module | null = null;
let chain = Promise.resolve();

function answer(request: Request): { json: string; words: Int32Array[]; ms: number } {
  if (!module) throw new Error("the engine has not started");
  const text = JSON.stringify(request);
  const bytes = module.lengthBytesUTF8(text) + 1;
  const at = module._malloc(bytes);
  module.stringToUTF8(text, at, bytes);
  const begun = performance.now();
  const count = module._lab_answer(at);
  const ms = performance.now() - begun;
  module._free(at);
  const json = module.UTF8ToString(module._lab_json());
  const heads: { width: number; height: number; channels: number }[] = count ? JSON.parse(json).pictures : [];
  const words = heads.map(({ width, height, channels }, i) => {
    const first = (module as Module)._lab_words(i) / 4;
    return (module as Module).HEAP32.slice(first, first + width * height * channels);
  });
  return { json, words, ms };
}

async function take(message: ToWorker): Promise<void> {
  if (message.kind === "start") {
    const instantiateWasm: Instantiate = (imports, done) => {
      void WebAssembly.instantiate(message.module, imports).then((instance) => done(instance, message.module));
      return {};
    };
    module = await engine({ instantiateWasm, print: () => undefined, printErr: () => undefined });
    module.FS.mkdir("/files");
    scope.postMessage({ kind: "ready" });
  } else if (message.kind === "file") {
    const folder = message.name.indexOf("/");
    if (folder > 0 && !module?.FS.analyzePath(`/files/${message.name.slice(0, folder)}`).exists) module?.FS.mkdir(`/files/${message.name.slice(0, folder)}`);
    module?.FS.writeFile(`/files/${message.name}`, new Uint8Array(await message.blob.arrayBuffer()));
  } else if (message.kind === "remove") {
    module?.FS.unlink(`/files/${message.name}`);
  } else {
    try {
      const { json, words, ms } = answer(message.request);
      scope.postMessage({ kind: "answer", id: message.id, json, words, ms }, words.map((each) => each.buffer));
    } catch (error) {
      scope.postMessage({ kind: "failed", id: message.id, message: error instanceof Error ? error.message : String(error), dead: true });
    }
  }
}

scope.onmessage = ({ data }) => {
  chain = chain
    .then(() => take(data))
    .catch((error) => scope.postMessage({ kind: "failed", id: data.kind === "ask" ? data.id : -1, message: error instanceof Error ? error.message : String(error), dead: data.kind === "start" }));
};
