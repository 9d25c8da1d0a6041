// SPDX-License-Identifier: Apache-2.0
// Scales from numbers to positions, with ticks.

export interface Scale {
  (value: number): number;
  ticks: number[];
}

/** A step of 1, 2 or 5 times a power of ten, so that `span` has about `count` steps. */
export function nice_step(span: number, count: number): number {
  const rough = span / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const part = rough / power;
  return power * (part > 5 ? 10 : part > 2 ? 5 : part > 1 ? 2 : 1);
}

/** Maps values low..high to positions from..to. */
export function linear(low: number, high: number, from: number, to: number, count = 5): Scale {
  const span = high - low || 1;
  const step = nice_step(span, count);
  const ticks: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(Number((i * step).toPrecision(12)));
  return Object.assign((value: number) => from + ((value - low) / span) * (to - from), { ticks });
}

/** The same on a logarithmic scale; low and high above 0, ticks at powers of ten (about `count` of them). */
export function logarithmic(low: number, high: number, from: number, to: number, count = 6): Scale {
  const [a, b] = [Math.log10(low), Math.log10(high)];
  const span = b - a || 1;
  const first = Math.ceil(a - 1e-9);
  const every = Math.max(1, Math.ceil((Math.floor(b + 1e-9) - first + 1) / count));
  const ticks: number[] = [];
  for (let power = first; power <= b + 1e-9; power += every) ticks.push(10 ** power);
  return Object.assign((value: number) => from + ((Math.log10(Math.max(value, low)) - a) / span) * (to - from), { ticks });
}
