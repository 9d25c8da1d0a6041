// SPDX-License-Identifier: Apache-2.0
// Unpacks the engine from the page: base64 of gzip in <script type="text/plain">.
import type { Program } from "./engine";

async function unpacked(id: string): Promise<ArrayBuffer> {
  const text = document.getElementById(id)?.textContent ?? "";
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

export async function load_program(): Promise<Program> {
  const [wasm, script] = await Promise.all([unpacked("engine-wasm"), unpacked("engine-script")]);
  const module = await WebAssembly.compile(wasm);
  return { module, script: URL.createObjectURL(new Blob([script], { type: "text/javascript" })) };
}
