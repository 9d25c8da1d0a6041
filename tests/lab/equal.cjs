// SPDX-License-Identifier: Apache-2.0
// Asks the lab's engine as WebAssembly and as a native program the same, and compares whole answers: words by their hash,
// texts exactly, figures to nine digits (the C libraries' exp and log differ in the last bit).
//   usage: equal.cjs LAB_JS NATIVE
const { readFileSync } = require("node:fs");
const { join } = require("node:path");
const { spawnSync } = require("node:child_process");
const engine = require(process.argv[2]);

const size = { "image.width": "48", "image.height": "40" };
const turned = { ...size, "camera.azimuth": "37", "camera.elevation": "-12" };
const perspective = { ...turned, "camera.projection": "perspective" };

/** Scenes by their technique, each with devices that draw it beside all named ones. */
function scenes() {
  const out = [];
  for (const method of ["image_aligned", "axis_aligned", "xray", "raycast", "westover"])
    for (const settings of [turned, perspective])
      for (const volume of ["shells:40", "marschner-lobb:36"]) out.push({ volume, settings: { ...settings, method } });
  for (const volume of ["binary-cube:40", "layer:32", "pair:33", "terrain:40", "constant:24", "checkerboard-tunnel:32"]) out.push({ volume, settings: turned });
  out.push(
    { volume: "shells:36", settings: { ...turned, "classify.order": "post" }, devices: [["classify.segment_bits=9"]] },
    { volume: "checkerboard-floor:36", tf: "checker", settings: { ...perspective, "footprint.antialias": "on" } },
    { volume: "binary-cube:36", settings: { ...perspective, "lens.depth_of_field": "splats", "lens.aperture": "4" } },
    { volume: "fire:36", settings: { ...turned, "splat_texture.amplitude": "0.7" }, devices: [["index.kind=blit2d", "snap.phases=8"]] },
    { volume: "shells:36", kernel: "smooth", settings: { ...turned, "slabs.width": "2.3", "slabs.opacity": "additive", "culling.freeze": "0.1" } },
  );
  return out;
}

function requests(tables) {
  const out = [];
  const kinds = tables.keys.find((one) => one.name === "index.kind").names.map((kind) => [`index.kind=${kind}`]);
  const devices = [...kinds, ["cull.map=block"], ["radial.interpolate=1"], ["composite.every_sample=1"], ["rounding.carry=on"], ["sheet.frac_bits=10", "pixel.frac_bits=8"]];
  for (const { devices: own = [], ...scene } of scenes()) {
    for (const { name: config } of tables.configs) out.push({ ask: "frame", ...scene, config });
    for (const changes of [...devices, ...own]) out.push({ ask: "frame", ...scene, config: "base", changes });
    out.push({ ask: "cycles", ...scene, config: "tiny" });
    out.push({ ask: "histogram", ...scene });
  }
  for (const settings of [turned, perspective]) {
    out.push({ ask: "errors", volume: "shells:40", settings, config: "base" });
    out.push({ ask: "pixel", volume: "shells:40", settings, config: "tiny", x: 20, y: 18 });
    for (const config of ["base", "tiny"]) out.push({ ask: "terminated", volume: "shells:40", settings: { ...settings, opacity_scale: "9" }, config });
  }
  for (const { name: config } of tables.configs) out.push({ ask: "config", config });
  out.push(...gaussian_requests(tables));
  out.push({ ask: "frame", config: "none" }, { ask: "frame", volume: "shells:9999" }, { ask: "frame", settings: { "camera.azimuth": "x" } }, { ask: "nothing" });
  return out;
}

/** 3-D Gaussians: built in and from files, several views, and devices that refuse them. */
function gaussian_requests(tables) {
  const { gaussian_config: config, gaussian_changes } = tables;
  const changes = Object.entries(gaussian_changes).map(([key, value]) => `${key}=${value}`);
  const out = [];
  for (const gaussians of ["shells:400", "cloud:300", "shells:2000"])
    for (const settings of [turned, perspective, { ...perspective, "camera.zoom": "2", "gaussians.cutoff": "2.5", "gaussians.up": "-y" }, { ...perspective, "gaussians.low_pass": "1.5" }]) {
      for (const more of [[], ["pixel.frac_bits=9"], ["radial.interpolate=1"], ["composite.freeze_below=0"]]) out.push({ ask: "frame", gaussians, settings, config, changes: [...changes, ...more] });
      out.push({ ask: "cycles", gaussians, settings, config, changes });
    }
  for (const { name } of tables.configs) out.push({ ask: "frame", gaussians: "shells:100", settings: perspective, config: name });
  for (const ask of ["errors", "pixel", "histogram", "terminated"]) out.push({ ask, gaussians: "shells:100", settings: perspective, config, changes, x: 1, y: 1 });
  for (const x of [12, 24, 30]) out.push({ ask: "pixel", gaussians: "shells:400", settings: perspective, config, changes, x, y: 20 });
  out.push({ ask: "frame", gaussians: "shells:9000000" }, { ask: "frame", gaussians: "none" }, { ask: "frame", gaussians: "shells:100", settings: { "gaussians.cutoff": "9" } });
  return out;
}

/** The first place where two answers differ, or null. */
function difference(a, b, path = "") {
  if (typeof a === "number" && typeof b === "number") return Math.abs(a - b) <= 1e-9 * (1 + Math.abs(a)) ? null : `${path}: ${a}, ${b}`;
  if (a === null || b === null || typeof a !== "object" || typeof b !== "object") return a === b ? null : `${path}: ${a}, ${b}`;
  const keys = Object.keys(a);
  if (keys.join() !== Object.keys(b).join()) return `${path}: ${keys}, ${Object.keys(b)}`;
  for (const key of keys) {
    const found = difference(a[key], b[key], `${path}.${key}`);
    if (found) return found;
  }
  return null;
}

engine().then((m) => {
  const ask = (text) => {
    const bytes = m.lengthBytesUTF8(text) + 1, at = m._malloc(bytes);
    m.stringToUTF8(text, at, bytes);
    m._lab_answer(at);
    m._free(at);
    return JSON.parse(m.UTF8ToString(m._lab_json()));
  };
  const list = requests(ask('{"ask":"tables"}')).map((one) => JSON.stringify(one));
  const native = spawnSync(process.argv[3], { input: `${list.join("\n")}\n`, maxBuffer: 1 << 30, encoding: "utf8" });
  const theirs = native.stdout.trimEnd().split("\n");
  const hashes = new Set();
  let frames = 0, refused = 0, words = 0, differ = 0;
  list.forEach((text, i) => {
    const a = ask(text), b = JSON.parse(theirs[i] ?? "{}");
    if (a.words_hash) ++frames, hashes.add(a.words_hash);
    if (a.error || a.device_error) ++refused;
    if (a.words_hash !== b.words_hash) ++words;
    const found = difference(a, b);
    if (!found) return;
    if (++differ <= 5) console.log(`DIFFERS ${text}\n  ${found.slice(0, 300)}`);
  });
  // The page of the guide has the figures of this test.
  const said = readFileSync(join(__dirname, "../../docs/lab.md"), "utf8").replace(/\s+/g, " ");
  const told = [`${list.length} answers`, `${frames} frames`].filter((text) => !said.includes(text));
  if (told.length) console.log(`docs/lab.md does not say: ${told.join(", ")}`);
  console.log(`[figure] answers = ${list.length}, refusals among them = ${refused}`);
  console.log(`[figure] frames with words = ${frames}, different ones = ${hashes.size} (limit >= 300 and 100)`);
  console.log(`[figure] frames whose words differ = ${words}, answers that differ = ${differ} (limit 0)`);
  process.exit(differ === 0 && told.length === 0 && theirs.length === list.length && frames >= 300 && hashes.size >= 100 ? 0 : 1);
});
