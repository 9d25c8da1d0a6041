// SPDX-License-Identifier: Apache-2.0
// usage: compare.mjs NAME OURS.ply THEIRS.ply exact|splat|turned: prints the largest difference of each attribute; exit code 1 if one is too large
import { readFileSync } from "node:fs";

const [name, ours, theirs, rule] = process.argv.slice(2);

/** The rows of a binary PLY of floats, by property. */
function columnsOf(path) {
  const bytes = readFileSync(path);
  const end = bytes.indexOf("end_header\n") + "end_header\n".length;
  const header = bytes.subarray(0, end).toString("latin1");
  const count = Number(/element vertex (\d+)/.exec(header)[1]);
  const names = [...header.matchAll(/property float (\w+)/g)].map((match) => match[1]);
  const columns = Object.fromEntries(names.map((one) => [one, new Float64Array(count)]));
  for (let row = 0; row < count; ++row)
    names.forEach((one, i) => { columns[one][row] = bytes.readFloatLE(end + 4 * (row * names.length + i)); });
  return { count, columns };
}

const a = columnsOf(ours), b = columnsOf(theirs);
if (a.count !== b.count) {
  console.log(`${name}: ${a.count} Gaussians and ${b.count}`);
  process.exit(1);
}
const worst = (names, value) => {
  let most = 0;
  for (const one of names)
    for (let i = 0; i < a.count; ++i) most = Math.max(most, Math.abs(value(a.columns[one][i]) - value(b.columns[one][i])));
  return most;
};
const same = (value) => value, share = (logit) => 1 / (1 + Math.exp(-logit));
const rest = Object.keys(a.columns).filter((one) => one.startsWith("f_rest_"));
if (rest.some((one) => !(one in b.columns))) throw new Error(`${name}: ${theirs} has fewer harmonics`);
/** Length of the difference of unit rotations; a rotation and its opposite are the same. */
const apart = (own, other) => {
  const length = Math.hypot(...other), sign = own.reduce((sum, value, k) => sum + value * other[k], 0) < 0 ? -1 : 1;
  return Math.hypot(...own.map((value, k) => value - (sign * other[k]) / length));
};
/** Half turns about a Gaussian's own axes change nothing; programs that change the scene's axes differ by them. */
const turned = ([w, x, y, z]) => [[w, x, y, z], [-x, w, z, -y], [-y, -z, w, x], [-z, y, -x, w]];
let turn = 0;
for (let i = 0; i < a.count; ++i) {
  const own = [0, 1, 2, 3].map((k) => a.columns[`rot_${k}`][i]), other = [0, 1, 2, 3].map((k) => b.columns[`rot_${k}`][i]);
  turn = Math.max(turn, rule === "turned" ? Math.min(...turned(own).map((one) => apart(one, other))) : apart(own, other));
}
const differences = {
  position: worst(["x", "y", "z"], same), "log scale": worst(["scale_0", "scale_1", "scale_2"], same), rotation: turn,
  opacity: worst(["opacity"], share), colour: worst(["f_dc_0", "f_dc_1", "f_dc_2"], same), harmonics: worst(rest, same),
};
// Opacities are clamped to 1e-6 from the ends. A byte of a .splat's rotation is (b - 128)/128 here and b/127.5 - 1 there:
// apart by up to 1/128 in each of four components.
const most = { position: 2e-6, "log scale": 2e-6, rotation: rule === "splat" ? 2 / 128 : 1e-5, opacity: 2e-6, colour: 2e-6, harmonics: 2e-6 };
console.log(`[figure] ${name}: ${Object.entries(differences).map(([key, value]) => `${key} ${value.toExponential(1)}`).join(", ")}`);
const wrong = Object.keys(most).filter((key) => !(differences[key] <= most[key]));
if (wrong.length) console.log(`${name}: too far apart: ${wrong.join(", ")}`);
process.exit(wrong.length ? 1 : 0);
