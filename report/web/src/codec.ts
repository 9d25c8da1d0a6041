// SPDX-License-Identifier: Apache-2.0
// Decodes a picture's block to words: base64, raw deflate, byte planes, differences (docs/report.md has the format).
import type { Picture } from "./page";

export type Words = Int32Array | Uint32Array;

function bytes_of(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Bytes per word: 2 for "split16-deflate". */
export function word_bytes(codec: string): number {
  const match = /^split(8|16|24|32)-deflate$/.exec(codec);
  if (!match) throw new Error(`no codec is called ${codec}`);
  return Number(match[1]) / 8;
}

/** Planes to words: one plane per byte of each channel, lowest first; each word is a difference from its left
 *  neighbour. */
export function joined(planes: Uint8Array, width: number, height: number, channels: number, bytes: number, signed: boolean): Words {
  const pixels = width * height;
  if (planes.length !== pixels * channels * bytes) throw new Error(`${planes.length} bytes, expected ${pixels * channels * bytes}`);
  const words = signed ? new Int32Array(pixels * channels) : new Uint32Array(pixels * channels);
  const row = width * channels;
  const mask = bytes === 4 ? 0xffffffff : 2 ** (8 * bytes) - 1;
  for (let c = 0; c < channels; ++c) {
    const first = c * bytes * pixels;
    for (let pixel = 0, at = c; pixel < pixels; ++pixel, at += channels) {
      let difference = 0;
      for (let b = bytes - 1; b >= 0; --b) difference = (difference << 8) | planes[first + b * pixels + pixel];
      const before = at % row >= channels ? words[at - channels] : at >= row ? words[at - row] : 0;
      words[at] = (before + difference) & mask;
    }
  }
  if (signed) for (let i = 0, shift = 32 - 8 * bytes; i < words.length; ++i) words[i] = (words[i] << shift) >> shift;
  return words;
}

/** Little-endian on every machine. */
function plain_bytes(words: Words, bytes: number): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(words.length * bytes);
  for (let i = 0, at = 0; i < words.length; ++i) {
    for (let b = 0; b < bytes; ++b) out[at++] = (words[i] >>> (8 * b)) & 255;
  }
  return out;
}

/** Decodes a picture and checks its hash; throws an Error that names the picture and the problem. */
export async function decoded(picture: Picture, block: string): Promise<Words> {
  try {
    const bytes = word_bytes(picture.codec);
    const planes = await inflated(bytes_of(block)).catch(() => {
      throw new Error("its data is damaged or cut off");
    });
    const words = joined(planes, picture.width, picture.height, picture.channels, bytes, picture.signed === true);
    const digest = await crypto.subtle.digest("SHA-256", plain_bytes(words, bytes));
    const hash = Array.from(new Uint8Array(digest), (byte) => byte.toString(16).padStart(2, "0")).join("");
    if (hash !== picture.sha256) throw new Error("its words are not those that were put in (SHA-256)");
    return words;
  } catch (error) {
    throw new Error(`picture ${picture.title} (${picture.from}): ${error instanceof Error ? error.message : error}`);
  }
}
