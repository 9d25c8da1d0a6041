// SPDX-License-Identifier: Apache-2.0
// A merged plan of so many rows, made up in the shape of `plan merge`: for what takes more rows than a test can run.

/** Numbers that look random and are the same every time. */
function chance(seed) {
  let state = seed >>> 0;
  return () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0), state / 2 ** 32);
}

export function sample_plan(count) {
  const next = chance(7);
  const axes = [
    { name: "sheet.frac_bits", title: "sheet fraction bits", values: [8, 10, 12, 14, 16] },
    { name: "snap.phases", values: [4, 8, 16, 32, 64] },
    { name: "index.kind", values: ["linear", "squared", "rlut"] },
  ];
  const rows = Array.from({ length: count }, (_, i) => {
    const [bits, phases, kind] = [axes[0].values[i % 5], axes[1].values[Math.floor(i / 5) % 5], axes[2].values[Math.floor(i / 25) % 3]];
    const rms = Math.hypot(30 * 2 ** -bits, 0.6 / phases) * (1 + next());
    const status = i % 97 === 50 ? "error" : i % 41 === 20 ? "fail" : "pass";
    return {
      id: (i + 1).toString(16).padStart(12, "0") + "abcd",
      kind: "compare",
      status,
      ...(status === "error" ? { message: "the case ended with exit code 5" } : {}),
      axes: { "sheet.frac_bits": bits, "snap.phases": phases, "index.kind": kind },
      metrics: status === "error" ? {} : { psnr_db: -20 * Math.log10(rms / 255), max_lsb8: 5 * rms, cost: Math.round(1e5 + bits * 2e4 + phases * 900 + 5e4 * next()) },
      config_hash: "025c7da2cf5f77b2",
      scene_hash: "91c2512dcaacef66",
      program_hash: "00112233",
      command: `fastsplat compare a.exr b.exr --json ${i}.json`,
    };
  });
  return {
    verb: "plan",
    version: "0.1.0",
    name: "word-lengths",
    hash: "8d3f00aa11223344",
    program: "00112233",
    axes,
    metrics: [
      { name: "psnr_db", title: "PSNR", unit: "dB", better: "more" },
      { name: "max_lsb8", title: "Max error", unit: "LSB8", better: "less" },
      { name: "cost", title: "Cost", unit: "gates", better: "less" },
    ],
    rows,
  };
}

/** Ids of the rows that passed and that no other beats, by comparing all with all. */
export function brute_front(plan, x, y) {
  const sign = (name) => (plan.metrics.find((metric) => metric.name === name).better === "more" ? -1 : 1);
  const rows = plan.rows.filter((row) => row.status === "pass");
  const bad = (row, name) => sign(name) * row.metrics[name];
  return rows
    .filter((row) => !rows.some((other) => bad(other, x) <= bad(row, x) && bad(other, y) <= bad(row, y) && (bad(other, x) < bad(row, x) || bad(other, y) < bad(row, y))))
    .map((row) => row.id);
}
