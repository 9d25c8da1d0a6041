// SPDX-License-Identifier: Apache-2.0
// Types of the engine's requests and answers: the contract with lab/session.cpp.
import type { Result } from "../../../report/web/src/page";

export interface Setting {
  name: string;
  flag: string;
  group: string;
  unit: string;
  help: string;
  default: string;
  kind: "real" | "integer" | "triple" | "box" | "choice";
  low?: number;
  high?: number;
  choices?: string[];
}

export interface Key {
  name: string;
  low: number;
  high: number;
  power_of_two: boolean;
  meaning: string;
  /** Names of the values from `low` on; empty for numbers. */
  names: string[];
}

export interface Tables {
  version: string;
  settings: Setting[];
  keys: Key[];
  configs: { name: string; description: string }[];
  volumes: { name: string; size: number }[];
  /** Built-in scenes of 3-D Gaussians, settings of their own, and a device for them. */
  gaussians: string[];
  gaussian_settings: Setting[];
  gaussian_config: string;
  gaussian_changes: Record<string, string>;
  /** What a page draws, pixels, and takes, bytes. */
  limits: { least_side: number; most_side: number; most_bytes: number };
  presets: string[];
  kernels: string[];
}

/** A picture's description; its words follow separately. */
export interface PictureHead {
  id: string;
  width: number;
  height: number;
  channels: number;
  scale: number;
  int_bits: number;
  /** The values are sRGB. */
  encoded: boolean;
}

export interface Cost {
  storage_bits: number;
  adder_bits: number;
  multiplier_bits: number;
  total: number;
}

export interface Config {
  name: string;
  hash: string;
  values: Record<string, string>;
  cost: Cost | null;
  /** Per technology: lut, ff, bram, dsp. Null if this device was not synthesised. */
  synthesis: Record<string, Record<string, number | string>> | null;
  /** Estimate of the area model. Null if the RTL cannot be built from it. */
  area: Record<string, number | string> | null;
  toml?: string;
}

export interface Frame {
  idle: Record<string, string>;
  command: string;
  remarks: string[];
  width: number;
  height: number;
  config: Config;
  device_error?: string;
  words_hash?: string;
  /** As `fastsplat compare --json` has it. */
  compare?: Result;
  records?: number;
}

export interface Histogram {
  min: number;
  max: number;
  bins: number[];
  tf: string;
  points: { at: number; colour: [number, number, number]; opacity: number }[];
  dims: [number, number, number];
  /** The resolved transfer function as TOML, if the engine has it. */
  toml?: string;
}

export interface Value {
  real: number | null;
  device: number | null;
  word: number | null;
}

export interface Story {
  x: number;
  y: number;
  channel: string;
  terminated: boolean;
  pixel: Record<string, Value>;
  error_lsb8: number[];
  steps: { name: string; by: string; keys: string; error_lsb8: number[] }[];
  frac_bits: Record<string, number>;
  /** Where each comes from: a voxel of the volume, or a Gaussian of the file. */
  splats: { voxel?: [number, number, number]; gaussian?: number; values: Record<string, Value> }[];
  sheets: { sheet: number; shares: { splat: number; values: Record<string, Value> }[]; together: Record<string, Value> }[];
}

export interface Request {
  ask: "tables" | "frame" | "cycles" | "errors" | "terminated" | "pixel" | "histogram" | "config" | "link";
  volume?: string;
  /** In place of the volume; "" for none. */
  gaussians?: string;
  tf?: string;
  kernel?: string;
  settings?: Record<string, string>;
  config?: string;
  changes?: string[];
  toml?: string;
  /** Without SSIM. */
  quick?: boolean;
  x?: number;
  y?: number;
  link?: string;
}

export interface Answer<T = Result> {
  json: T;
  pictures: { head: PictureHead; words: Int32Array }[];
  /** Milliseconds in the engine. */
  ms: number;
}
