// SPDX-License-Identifier: Apache-2.0
// The lab's page in headless Chromium, from disk and without a network, for the tests.
//   LAB        the page
//   CHROMIUM   the browser
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";
import { chromium } from "playwright-core";

const browser_path = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-headless-shell"].find((path) => path && existsSync(path));
const folder = mkdtempSync(join(tmpdir(), "fastsplat-lab-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

export const place = (name) => join(folder, name);
export function save(name, bytes) {
  writeFileSync(place(name), bytes);
  return place(name);
}
export function figure(name, value, limit = "") {
  console.log(`[figure] ${name} = ${value}${limit ? ` (limit ${limit})` : ""}`);
}
export const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

let browser = null;
export async function start() {
  assert.ok(browser_path, "no chromium: install the Debian package chromium, or name one by CHROMIUM");
  browser = await chromium.launch({ executablePath: browser_path, args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--font-render-hinting=none", "--force-color-profile=srgb"] });
}
export const stop = () => browser?.close();

/** Opens the lab and waits for its first picture. close() checks that nothing was logged or requested. */
export async function open({ width = 1280, height = 900, theme = "light", hash = "", touch = false } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, deviceScaleFactor: 1, colorScheme: theme, reducedMotion: "reduce", offline: true, locale: "en-US", hasTouch: touch });
  const page = await context.newPage();
  const problems = [];
  page.on("console", (message) => problems.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`exception: ${error.message}`));
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(pathToFileURL(process.env.LAB).href) && !/^(data|blob):/.test(url)) problems.push(`request: ${url}`);
  });
  await page.addInitScript(() => {
    window.copied = [];
    Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => void window.copied.push(text) } });
  });
  const begun = Date.now();
  await page.goto(pathToFileURL(process.env.LAB).href + hash);
  await page.waitForSelector("html[data-ready]", { timeout: 60_000 });
  page.first_ms = Date.now() - begun;
  assert.equal(await page.getAttribute("html", "data-ready"), "1", problems.join("; "));
  page.finish = async () => {
    await context.close();
    assert.deepEqual(problems, []);
  };
  return page;
}

export const data = (page) => page.evaluate(() => ({ ...document.documentElement.dataset }));
export const shown_hash = (page) => page.textContent("#words-hash");
export const psnr = (page) => page.textContent('#figures [data-figure="0.psnr_db"]');

/** Runs `act` and waits until a frame at rest has come after it. */
export async function rest(page, act, { timeout = 60_000 } = {}) {
  const before = Number((await data(page)).frames ?? 0);
  await act();
  await page.waitForFunction((n) => Number(document.documentElement.dataset.frames) > n && document.documentElement.dataset.settled === "true", before, { timeout });
  return data(page);
}
export const settled = (page) => page.waitForFunction(() => document.documentElement.dataset.settled === "true", null, { timeout: 60_000 });

/** Sets a number field and leaves it. */
export async function type(page, name, value) {
  const field = page.locator(`.control[data-name="${name}"] input[type="number"]`);
  await reveal(page, name);
  await field.fill(String(value));
  await field.press("Tab");
}
/** Opens the group of a control. */
export const reveal = (page, name) => page.evaluate((n) => {
  const control = document.querySelector(`.control[data-name="${n}"]`);
  document.getElementById(control.closest("[role=tabpanel]").getAttribute("aria-labelledby")).click();
  const details = control.closest("details");
  if (details) details.open = true;
}, name);

/** What axe-core finds serious or critical: a rule and an element each. */
export async function serious(page) {
  await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"));
  return page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations.filter(({ impact }) => ["serious", "critical"].includes(impact)).flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.target}`));
  });
}

// --- volumes -----------------------------------------------------------------------------------------------------------

/** A ball of bytes, `n` voxels a side. */
function ball(n) {
  const bytes = Buffer.alloc(n ** 3);
  for (let z = 0, i = 0; z < n; ++z) for (let y = 0; y < n; ++y) for (let x = 0; x < n; ++x, ++i) bytes[i] = Math.max(0, 255 - 20 * Math.hypot(x - n / 2, y - n / 2, z - n / 2));
  return bytes;
}
export function nrrd(n, data = ball(n)) {
  return Buffer.concat([Buffer.from(`NRRD0004\ntype: uint8\ndimension: 3\nsizes: ${n} ${n} ${n}\nencoding: raw\n\n`), data]);
}
export function nifti(n, gz = false) {
  const head = Buffer.alloc(352);
  head.writeInt32LE(348, 0);
  [3, n, n, n, 1, 1, 1, 1].forEach((v, i) => head.writeInt16LE(v, 40 + 2 * i));
  head.writeInt16LE(2, 70);
  head.writeInt16LE(8, 72);
  [1, 1, 1, 1].forEach((v, i) => head.writeFloatLE(v, 76 + 4 * i));
  head.writeFloatLE(352, 108);
  head.writeFloatLE(1, 112);
  head.write("n+1\0", 344, "latin1");
  const all = Buffer.concat([head, ball(n)]);
  return gz ? gzipSync(all) : all;
}
export function metaimage(n) {
  return Buffer.concat([Buffer.from(`ObjectType = Image\nNDims = 3\nDimSize = ${n} ${n} ${n}\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n`), ball(n)]);
}
