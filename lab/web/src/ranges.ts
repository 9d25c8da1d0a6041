// SPDX-License-Identifier: Apache-2.0
// Positions of sliders: linear, by powers of two, or logarithmic, over the part of a value's range that is of use.

export interface Range {
  /** Limits of the number field. */
  low: number;
  high: number;
  /** Positions of the slider: 0..steps. */
  steps: number;
  value(position: number): number;
  position(value: number): number;
  text(value: number): string;
}

/** Parts of wide ranges that a slider covers. The number field takes all values. */
const useful: Record<string, [low: number, high: number, steps: number]> = {
  "camera.azimuth": [-180, 180, 360],
  "camera.elevation": [-90, 90, 180],
  "camera.roll": [-180, 180, 360],
  "xray.sheets": [1, 64, 63],
  "xray.exposure": [0, 0.1, 200],
  "splat_texture.frame": [0, 63, 63],
  "lens.aperture": [0, 100, 200],
  "lens.focus": [-200, 200, 400],
  "slabs.width": [0.1, 8, 79],
};
const powers = new Set(["camera.zoom", "opacity_scale", "texture.scale", "bump.scale"]);

const plain = (value: number): string => String(Number(value.toPrecision(6)));

function linear(low: number, high: number, steps: number): Pick<Range, "steps" | "value" | "position"> {
  return { steps, value: (at) => low + ((high - low) * at) / steps, position: (value) => Math.round(((value - low) / (high - low)) * steps) };
}

/** 100 positions above and below `middle`, up to a factor of `span`. */
function logarithmic(middle: number, span: number): Pick<Range, "steps" | "value" | "position"> {
  const each = Math.log(span) / 100;
  return {
    steps: 200,
    value: (at) => Number((middle * Math.exp((at - 100) * each)).toPrecision(3)),
    position: (value) => Math.min(200, Math.max(0, Math.round(Math.log(value / middle) / each) + 100)),
  };
}

export function real_range(name: string, low: number, high: number, standard: number): Range {
  const found = useful[name];
  const how = found ? linear(...found) : powers.has(name) ? logarithmic(standard, name === "camera.zoom" ? 10 : 100) : linear(low, high, 200);
  return { low, high, ...how, text: plain };
}

export function integer_range(name: string, low: number, high: number, power_of_two: boolean): Range {
  const text = (value: number): string => String(Math.round(value));
  const found = useful[name];
  if (found) return { low, high, ...linear(...found), text };
  if (power_of_two) {
    const first = Math.log2(low);
    return { low, high, steps: Math.log2(high) - first, value: (at) => 2 ** (first + at), position: (value) => Math.round(Math.log2(value) - first), text };
  }
  if (high - low <= 4096) return { low, high, ...linear(low, high, high - low), text };
  // 0 or the least value, then powers of two.
  const first = Math.ceil(Math.log2(Math.max(1, low)));
  return {
    low,
    high,
    steps: Math.floor(Math.log2(high)) - first + 1,
    value: (at) => (at === 0 ? low : 2 ** (first + at - 1)),
    position: (value) => (value <= low ? 0 : Math.max(0, Math.round(Math.log2(value)) - first + 1)),
    text,
  };
}
