// SPDX-License-Identifier: Apache-2.0
// A browser for the tests: Debian's chromium, no network, one file; any console message fails the test.
//   FASTSPLAT   the program (build/bin/fastsplat)
//   CHROMIUM    the browser (chromium or chromium-headless-shell of the PATH's usual places)
//   TEMPLATE    another template than the program's: what `node build.mjs FILE` has just made
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const here = dirname(fileURLToPath(import.meta.url));
export const program = process.env.FASTSPLAT ?? join(here, "../../../build/bin/fastsplat");
export const browser_path = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-headless-shell"].find((path) => path && existsSync(path));

const folder = mkdtempSync(join(tmpdir(), "fastsplat-report-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

/** A path in the test's own folder. */
export function place(name) {
  return join(folder, name);
}

export function figure(name, value, limit = "") {
  console.log(`[figure] ${name} = ${value}${limit ? ` (limit ${limit})` : ""}`);
}

/** Runs the program in the test's folder; exit codes in `codes` are no error. */
export function fastsplat(args, codes = [0]) {
  try {
    return execFileSync(program, args, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
  } catch (error) {
    assert.ok(codes.includes(error.status), `fastsplat ${args.join(" ")}: ${error.stderr}`);
    return error.stdout;
  }
}

/** The JSON result of a verb, also left as NAME.json. */
export function result(name, args, codes) {
  fastsplat([...args, "--json", `${name}.json`, "--quiet"], codes);
  return JSON.parse(readFileSync(place(`${name}.json`), "utf8"));
}

export function save(name, value) {
  writeFileSync(place(name), typeof value === "string" ? value : JSON.stringify(value));
  return name;
}

/** `fastsplat report` of files in the test's folder: the page's path. */
export function report(name, results, more = []) {
  fastsplat(["report", ...results, "-o", `${name}.html`, "--quiet", ...more]);
  if (process.env.TEMPLATE) {
    const data = /<script type="(?:application\/json|text\/plain)"[^]*?<\/script>/g;
    const blocks = readFileSync(place(`${name}.html`), "utf8").match(data).join("");
    save(`${name}.html`, readFileSync(process.env.TEMPLATE, "utf8").replace("<!--FASTSPLAT-DATA-->", () => blocks));
  }
  return place(`${name}.html`);
}

let started = null;
export async function start() {
  assert.ok(browser_path, "no chromium: install the Debian package chromium, or name one by CHROMIUM");
  started = await chromium.launch({
    executablePath: browser_path,
    args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--font-render-hinting=none", "--force-color-profile=srgb", "--disable-lcd-text"],
  });
}
export async function stop() {
  await started?.close();
}

/** Opens a page that must be ready, quiet and alone: close() checks that it stayed so. */
export async function open(file, { width = 1000, height = 900, theme = "light", ready = "1", hash = "" } = {}) {
  const context = await started.newContext({ viewport: { width, height }, deviceScaleFactor: 1, colorScheme: theme, reducedMotion: "reduce", offline: true, locale: "en-US", timezoneId: "UTC" });
  const page = await context.newPage();
  const url = pathToFileURL(file).href;
  const problems = [];
  page.on("console", (message) => (["error", "warning"].includes(message.type()) ? problems.push(`console: ${message.text()}`) : null));
  page.on("pageerror", (error) => problems.push(`exception: ${error.message}`));
  await page.route("**", (route) => {
    const wanted = route.request().url();
    if (wanted === url + hash || wanted === url || wanted.startsWith("data:")) return route.continue();
    problems.push(`request: ${wanted}`);
    return route.abort();
  });
  await page.addInitScript(() => {
    window.copied = [];
    Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => void window.copied.push(text) } });
  });
  await page.goto(url + hash);
  await page.waitForSelector("html[data-ready]", { timeout: 20_000 });
  const state = await page.getAttribute("html", "data-ready");
  assert.equal(state, ready, `the page's state; ${problems.join("; ")}`);
  page.finish = async (expected = []) => {
    const rest = problems.filter((problem) => !expected.some((pattern) => pattern.test(problem)));
    await context.close();
    assert.deepEqual(rest, []);
  };
  return page;
}

/** Two frames: what was asked to be drawn has been. */
export const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))));

/** RGBA at a place of a canvas, in its own pixels. By way of another canvas: reading the page's own makes it slow. */
export function canvas_pixel(page, selector, x, y) {
  return page.$eval(
    selector,
    (canvas, [px, py]) => {
      const context = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
      context.drawImage(canvas, -px, -py);
      return [...context.getImageData(0, 0, 1, 1).data];
    },
    [x, y],
  );
}

/** What the page's data element holds. */
export async function data_of(page) {
  return JSON.parse(await page.evaluate(() => document.getElementById("data").textContent));
}

/** "12 345.6 dB" of the page as a number and half of its last digit; null for a dash. */
export function shown_number(text) {
  const plain = text.replaceAll("\u202f", "").replaceAll("\u2212", "-").replaceAll("\u00a0", " ").trim();
  if (plain === "\u2013") return null;
  const found = /^([+-]?)(\d+(?:\.(\d+))?)(?:e([+-]?\d+))?/.exec(plain);
  assert.ok(found, `"${text}" is no number`);
  return { value: Number(found[1] + found[2] + (found[4] ? `e${found[4]}` : "")), half: 0.5 * 10 ** (Number(found[4] ?? 0) - (found[3] ?? "").length) };
}

export function at(results, path) {
  return path.split(".").reduce((value, key) => value?.[key.replaceAll("%2e", ".").replaceAll("%25", "%")], results);
}

/** Every element with data-figure shows the number (or word) of its place in the results: how many were compared. */
export async function compare_figures(page, selector = "") {
  const { results } = await data_of(page);
  const shown = await page.$$eval(`${selector} [data-figure]`, (all) => all.map((each) => ({ path: each.dataset.figure, text: each.textContent, scale: Number(each.dataset.scale ?? 1) })));
  for (const { path, text, scale } of shown) {
    const value = at(results, path);
    if (typeof value === "string" || typeof value === "boolean") {
      assert.equal(text, String(value), path);
      continue;
    }
    const number = shown_number(text);
    if (number === null) {
      assert.ok(value === null || value === undefined, `${path}: a dash for ${value}`);
      continue;
    }
    assert.equal(typeof value, "number", `${path}: "${text}" is shown, and nothing there`);
    assert.ok(Math.abs(number.value - value * scale) <= number.half * 1.000001 + Math.abs(value * scale) * 1e-12, `${path}: "${text}" is shown for ${value} x ${scale}`);
  }
  return shown.length;
}
