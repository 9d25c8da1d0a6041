// SPDX-License-Identifier: Apache-2.0
// The viewer in headless Chromium: its words are the files', its pictures their own, slider, zoom and keys move them.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { canvas_pixel, compare_figures, data_of, drawn, fastsplat, figure, open, place, report, result, save, start, stop } from "./browser.mjs";

const scene = ["--volume", "shells:16", "--size", "48"];
let whole, failing, differ;

before(async () => {
  await start();
  result("golden", ["render", ...scene, "--engine", "golden", "-o", "golden.exr"]);
  result("cmodel", ["render", ...scene, "--engine", "cmodel", "--config", "base", "-o", "cmodel.exr", "--raw", "raw.exr"]);
  result("compare", ["compare", "golden.exr", "cmodel.exr", "--min-psnr", "30"]);
  result("errors", ["errors", ...scene, "--config", "base", "--quick", "--blame", "blame.png"]);
  whole = report("whole", ["compare.json", "errors.json", "cmodel.json", "golden.json"]);
  // Two pictures without similarity: the content of a pane identifies its picture.
  fastsplat(["render", "--volume", "binary-cube:16", "--size", "48", "--azimuth", "20", "-o", "left.exr", "--quiet"]);
  fastsplat(["render", ...scene, "-o", "right.exr", "--quiet"]);
  differ = result("differ", ["compare", "left.exr", "right.exr", "--max-lsb", "1"], [1]);
  failing = report("failing", ["differ.json"], ["--picture", "left=left.exr", "--picture", "right=right.exr"]);
});
after(stop);

const dumps = new Map();

/** The channels of a pixel, by OpenImageIO's own tool. */
function pixel_of(name, x, y) {
  if (!dumps.has(name)) dumps.set(name, execFileSync("oiiotool", ["--dumpdata", place(name)], { encoding: "utf8", maxBuffer: 1 << 28 }));
  const found = new RegExp(`Pixel \\(${x}, ${y}\\):([^(\\n]*)`).exec(dumps.get(name));
  assert.ok(found, `${name} has no pixel (${x}, ${y})`);
  return found[1].trim().split(/\s+/).map(Number);
}

/** sRGB as a screen has it, of a linear value. */
const encoded = (linear) => {
  const v = Math.min(1, Math.max(0, linear));
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
};

const under = (page) => page.getAttribute(".words caption", "data-at");
const shown_errors = (page) => page.$$eval('tr[data-words="error"] td.num:not(.values)', (cells) => cells.map((c) => Number(c.textContent.replace("\u2212", "-"))));

/** Pairs of boxes that lie on each other, of panels and of what stands in the viewer; runs in the page. */
function overlaps() {
  const found = [];
  const check = (elements) => {
    const boxes = elements.map((element) => [element, element.getBoundingClientRect()]).filter(([, box]) => box.width && box.height);
    for (let i = 0; i < boxes.length; ++i)
      for (let j = i + 1; j < boxes.length; ++j) {
        const [a, b] = [boxes[i][1], boxes[j][1]];
        const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (wide > 1 && high > 1) found.push(`${boxes[i][0].id || boxes[i][0].className} and ${boxes[j][0].id || boxes[j][0].className}`);
      }
  };
  check([...document.querySelectorAll("section.panel")]);
  for (const viewer of document.querySelectorAll(".viewer")) {
    check([...viewer.children]);
    check([...viewer.querySelectorAll(".pane")]);
  }
  for (const cell of document.querySelectorAll(".words td")) {
    const text = document.createRange();
    text.selectNodeContents(cell);
    const inner = text.getBoundingClientRect(), outer = cell.getBoundingClientRect();
    if (inner.width > outer.width + 1) found.push(`words of ${cell.parentElement.dataset.words} and their cell`);
  }
  for (const canvas of document.querySelectorAll(".frame canvas")) {
    const inner = canvas.getBoundingClientRect(), outer = canvas.parentElement.getBoundingClientRect();
    if (inner.right > outer.right + 1 || inner.bottom > outer.bottom + 1) found.push("a canvas and what stands around it");
  }
  return found;
}

test("the lab opens with a picture's scene and configuration", async () => {
  const page = await open(whole);
  const links = await page.$$eval("#open-in-lab a", (all) => all.map((each) => [each.getAttribute("href"), each.textContent]));
  assert.equal(links.length, 1, "one for golden's and the device's picture");
  const [href, text] = links[0];
  assert.match(href, /^lab\.html#lab\?scene=/);
  assert.match(text, /shells:16.*base.*48/);
  assert.match(await page.textContent("#open-in-lab"), /in lab\.html beside this page; \.\/run lab makes it/);
  assert.equal(fastsplat(["lab", "--print", href]), "fastsplat render --volume shells:16 --size 48 --engine cmodel --config base --out device.exr\n");
  await page.finish();
});

test("the lab opens with Gaussians and a changed configuration", async () => {
  const view = ["--gaussians", "cloud:50", "--size", "40x32", "--azimuth", "33", "--fov", "40", "--engine", "cmodel"];
  result("cloud", ["render", ...view, "--set", "radial.entries=128", "-o", "cloud.exr"]);
  result("placed", ["render", "--gaussians", "cloud:50", "--size", "40x32", "--eye", "3,1,1", "-o", "placed.exr"]);
  const page = await open(report("cloud", ["cloud.json", "placed.json"]));
  const links = await page.$$eval("#open-in-lab a", (all) => all.map((each) => each.getAttribute("href")));
  assert.equal(links.length, 1, "the lab has no placed cameras");
  const command = fastsplat(["lab", "--print", links[0]]).trim();
  assert.match(command, /--config ellipse .*--set radial.entries=128.* --out device.exr$/);
  fastsplat([...command.split(" ").slice(1), "--quiet"]);
  fastsplat(["compare", "cloud.exr", "device.exr", "--max-lsb", "0"]);
  await page.finish();
});

for (const [name, file] of [["whole", () => whole], ["failing", () => failing]]) {
  test(`${name}: light and dark, narrow and wide, nothing on another thing`, async () => {
    let checked = 0;
    for (const theme of ["light", "dark"]) {
      const page = await open(file(), { theme, hash: "#pictures?at=24,24" });
      for (const width of [390, 1000, 1280, 1800]) {
        await page.setViewportSize({ width, height: 900 });
        await drawn(page);
        assert.deepEqual(await page.evaluate(overlaps), [], `at ${width} ${theme}`);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.ok(wide <= 0, `at ${width} ${theme}: ${wide} pixels stick out`);
      }
      checked += await compare_figures(page, "[data-panel=pictures]");
      await page.finish();
    }
    figure(`${name}, figures of the viewer equal to the JSON`, checked, "> 0");
    assert.ok(checked > 0);
  });
}

test("the words under the pixel are the file's", async () => {
  let checked = 0;
  for (const [x, y] of [[24, 24], [13, 30], [31, 17]]) {
    const page = await open(whole, { hash: `#pictures?at=${x},${y}&zoom=8` });
    await drawn(page);
    assert.equal(await under(page), `${x},${y}`);
    const { id } = (await data_of(page)).pictures.find((picture) => picture.role === "integer");
    const words = await page.$$eval(`tr[data-words="${id}"] td.num:not(.values)`, (cells) => cells.map((c) => Number(c.textContent)));
    assert.deepEqual(words, pixel_of("raw.exr", x, y));
    const golden = pixel_of("golden.exr", x, y), test_ = words.map((word) => word / 65536);
    const errors = await shown_errors(page);
    errors.forEach((e, c) => assert.ok(Math.abs(e - (test_[c] - golden[c]) * 255) < 0.004, `channel ${c}: ${e}`));
    checked += words.length + errors.length;
    await page.finish();
  }
  figure("words and errors equal to oiiotool's", checked, "> 0");
  assert.ok(checked > 0);
});

/** The middle of a frame's pixel on the screen. */
async function spot_of(page, selector, x, y) {
  const box = await page.$eval(selector, (canvas) => {
    const { left, top } = canvas.getBoundingClientRect();
    return { left, top, width: canvas.clientWidth, height: canvas.clientHeight, scale: Number(canvas.dataset.scale) };
  });
  return { x: box.left + (x + 0.5) * box.scale, y: box.top + (y + 0.5) * box.scale, inner: [Math.floor((x + 0.5) * box.scale), Math.floor((y + 0.5) * box.scale)] };
}

/** A pixel in which the two pictures look as different as anywhere. */
function distinct() {
  let best = null;
  for (let y = 4; y < 44; y += 4)
    for (let x = 4; x < 44; x += 4) {
      const [a, b] = [pixel_of("left.exr", x, y), pixel_of("right.exr", x, y)].map((p) => p.slice(0, 3).map(encoded));
      const apart = Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]);
      if (!best || apart > best.apart) best = { x, y, a, b, apart };
    }
  return best;
}

const near = (got, expected, what) => got.slice(0, 3).forEach((v, c) => assert.ok(Math.abs(v - expected[c]) <= 1, `${what}: ${got} and not ${expected}`));

test("panes show their own picture, the slider parts them, zoom moves all", async () => {
  const { x, y, a, b, apart } = distinct();
  figure("how far the two pictures are apart on the screen", apart, "> 60");
  assert.ok(apart > 60);
  const page = await open(failing);
  const { pictures } = await data_of(page);
  const of = (file) => `canvas[data-view="${pictures.find((picture) => picture.from.endsWith(file)).id}"]`;
  const [left, right] = [of("left.exr"), of("right.exr")];
  const spot = await spot_of(page, left, x, y);
  near(await canvas_pixel(page, left, ...spot.inner), a, "left pane");
  near(await canvas_pixel(page, right, ...spot.inner), b, "right pane");

  // The cursor reads the pixel under it.
  await page.mouse.move(spot.x, spot.y);
  await drawn(page);
  assert.equal(await under(page), `${x},${y}`);

  // The wheel, after a click: every pane follows, and the point under the cursor stays.
  await page.mouse.click(spot.x, spot.y);
  const before_ = Number(await page.getAttribute(left, "data-scale"));
  for (let i = 0; i < 4; ++i) await page.mouse.wheel(0, -100);
  await drawn(page);
  for (const pane of [left, right]) assert.ok(Math.abs(Number(await page.getAttribute(pane, "data-scale")) / before_ - 4) < 1e-6, "zoom by 4");
  await page.mouse.move(spot.x + 0.01, spot.y);
  await drawn(page);
  assert.equal(await under(page), `${x},${y}`, "the pixel under the cursor stays under it");
  await page.waitForFunction(() => /^#pictures\?.*zoom=/.test(location.hash), null, { timeout: 5000 });

  // Keys: arrows move the pixel, 0 shows the whole.
  await page.keyboard.press("ArrowRight");
  await page.mouse.move(5, 5);
  await drawn(page);
  assert.equal(await under(page), `${x + 1},${y}`);
  await page.keyboard.press("0");
  await page.keyboard.press("Escape");

  // The slider: left of it one picture, right of it the other.
  await page.click('button[data-key="mode-slider"]');
  await drawn(page);
  const only = 'canvas[data-view="slider"]';
  const there = await spot_of(page, only, x, y);
  const split = async (value) => {
    await page.$eval("input.split", (input, v) => ((input.value = v), input.dispatchEvent(new Event("input"))), value);
    await drawn(page);
  };
  await split(1000);
  near(await canvas_pixel(page, only, ...there.inner), a, "left of the slider");
  await split(0);
  near(await canvas_pixel(page, only, ...there.inner), b, "right of the slider");
  const box = await page.$eval(only, (canvas) => canvas.getBoundingClientRect().toJSON());
  await page.mouse.move(box.left + 1, box.top + 40);
  await page.mouse.down();
  await page.mouse.move(box.left + box.width - 1, box.top + 60, { steps: 4 });
  await page.mouse.up();
  await drawn(page);
  near(await canvas_pixel(page, only, ...there.inner), a, "after the slider was drawn to the right");

  // In turn.
  await page.click('button[data-key="mode-flicker"]');
  await drawn(page);
  const turned = [];
  await page.focus('canvas[data-view="flicker"]');
  for (let i = 0; i < 2; ++i) {
    turned.push(await canvas_pixel(page, 'canvas[data-view="flicker"]', ...there.inner));
    await page.keyboard.press(" ");
    await drawn(page);
  }
  near(turned[0], a, "first in turn");
  near(turned[1], b, "second in turn");
  await page.finish();
});

test("the worst pixel is the compare's", async () => {
  const page = await open(failing);
  const { worst, clusters } = differ;
  await page.click('button[data-jump="worst"]');
  await page.mouse.move(2, 2);
  await drawn(page);
  assert.equal(await under(page), `${worst.x},${worst.y}`);
  const errors = await shown_errors(page);
  assert.ok(Math.abs(errors[worst.channel] - worst.error_lsb) < 0.01, `${errors} and not ${worst.error_lsb}`);
  assert.ok(Math.abs(worst.error_lsb) === Math.max(...errors.map(Math.abs)) || Math.abs(Math.abs(worst.error_lsb) - Math.max(...errors.map(Math.abs))) < 0.01);
  assert.ok(clusters.length > 0);
  await page.click('button[data-jump="cluster-0"]');
  await drawn(page);
  assert.equal(await under(page), `${clusters[0].worst.x},${clusters[0].worst.y}`);
  await page.finish();
});

/** What is seen between the page's contents and its lower edge; runs in the page. */
function seen() {
  const whole = (element, top, bottom) => {
    const box = element?.getBoundingClientRect();
    return !!box && box.height > 0 && box.top >= top - 1 && box.bottom <= bottom + 1;
  };
  const top = document.getElementById("contents").getBoundingClientRect().bottom;
  const words = document.querySelector(".words");
  const edge = document.querySelector("button[data-jump=worst]").getBoundingClientRect().top;
  // A row must not only be there: nothing lies on it.
  const uncovered = (row) => {
    const box = row?.getBoundingClientRect();
    return !!box && whole(row, top, innerHeight) && row.contains(document.elementFromPoint(box.left + 20, box.top + box.height / 2));
  };
  return {
    panes: [...document.querySelectorAll(".frame")].map((frame) => whole(frame, top, Math.min(innerHeight, edge))),
    values: whole(words, top, innerHeight) && [...document.querySelectorAll("tr[data-words]")].every(uncovered),
    picks: whole(document.querySelector("button[data-jump=worst]"), top, innerHeight),
  };
}

for (const [width, height] of [[1280, 800], [390, 844]]) {
  test(`${width} x ${height}: pixel, values and picks are seen together, in 1 to 4 panes`, async () => {
    let checked = 0;
    const page = await open(whole, { width, height });
    const { pictures } = await data_of(page);
    const keys = [pictures[0].id, pictures[1].id, "error", pictures.find((picture) => picture.role === "blame").id];
    for (const [mode, count] of [["side", 1], ["side", 2], ["side", 3], ["side", 4], ["slider", 1], ["flicker", 1]]) {
      await page.evaluate(([m, show]) => (location.hash = `#pictures?mode=${m}&show=${show}`), [mode, keys.slice(0, count).join(",")]);
      await page.waitForFunction(([m, n]) => document.querySelector(".panes").dataset.mode === m && document.querySelectorAll(".frame").length === n, [mode, count]);
      await drawn(page);
      for (let pane = 0; pane < count; ++pane) {
        // Scrolls until the picture is in the middle of the free area; then moves the pointer over it.
        const canvas = page.locator(".frame canvas").nth(pane);
        await canvas.evaluate((element) => {
          const box = element.getBoundingClientRect();
          scrollBy(0, box.top - 75);
        });
        await drawn(page);
        const box = await canvas.boundingBox();
        await page.mouse.move(box.x + box.width / 2 + 1, box.y + box.height / 2 + 1);
        await drawn(page);
        const now = await page.evaluate(seen);
        assert.ok(now.panes[pane], `${mode}, pane ${pane + 1} of ${count} is not seen whole`);
        assert.ok(now.values, `${mode}, pane ${pane + 1} of ${count}: values and error are not in sight`);
        assert.ok(now.picks, `${mode}, pane ${pane + 1} of ${count}: the picks of pixels are not in sight`);
        assert.equal(await under(page), "24,24");
        ++checked;
      }
      // From anywhere, the worst pixel is seen, and its values.
      for (const from of [0, 1e6]) {
        await page.evaluate((y) => scrollTo(0, y), from);
        await drawn(page);
        await page.evaluate(() => document.querySelector("button[data-jump=worst]").click());
        await drawn(page);
        const now = await page.evaluate(seen);
        assert.ok(now.panes.some(Boolean) && now.values, `${mode}, ${count} panes, from ${from}: the worst pixel is not in sight`);
        ++checked;
      }
      // And with the key, in the pane that has the focus.
      await page.locator(".frame canvas").nth(count - 1).focus();
      await page.evaluate(() => scrollTo(0, 1e6));
      await page.keyboard.press("w");
      await drawn(page);
      const now = await page.evaluate(seen);
      assert.ok(now.panes[count - 1] && now.values, `${mode}, ${count} panes, key w: the pane in use is not in sight`);
      ++checked;
    }
    figure(`panes and jumps with values in sight at ${width} x ${height}`, checked, "30");
    assert.equal(checked, 30);
    await page.finish();
  });
}

test("what a compare compared is looked at first, and the picture of another scene apart", async () => {
  result("cloud", ["render", "--gaussians", "shells:40", "--size", "48", "-o", "cloud.exr"]);
  result("coarse", ["render", ...scene, "--engine", "cmodel", "--set", "sheet.frac_bits=8", "-o", "coarse.exr"]);
  result("second", ["compare", "right.exr", "cmodel.exr", "--min-psnr", "30"]);
  const page = await open(report("apart", ["golden.json", "cloud.json", "coarse.json", "second.json"], ["--picture", "other=left.exr"]));
  const { pictures } = await data_of(page);
  const from = (id) => pictures.find((picture) => picture.id === id).compared;
  const scenes = await page.$$eval('.viewer select[aria-label="Scene"] option', (all) => all.map((option) => option.textContent));
  figure("scenes of the viewer", scenes.length, "3");
  assert.equal(scenes.length, 3, scenes.join("; "));
  assert.ok(scenes.some((name) => name.endsWith("shells:16, configurations base+sheet.frac_bits=8, base, 48 \u00d7 48 pixels")), scenes.join("; "));
  assert.ok(scenes.some((name) => /Gaussians, 48 \u00d7 48 pixels$/.test(name)), scenes.join("; "));
  const group = scenes.findIndex((name) => name.includes("base+"));
  await page.selectOption('.viewer select[aria-label="Scene"]', String(group));
  const pair = await page.$$eval(".viewer select", (all) => Object.fromEntries(all.map((select) => [select.getAttribute("aria-label"), select.value])));
  assert.deepEqual([from(pair.Reference), from(pair.Test)], [["3.ref"], ["3.test"]]);
  await page.finish();
});

test("a map of a smaller picture says its size", async () => {
  result("quarter", ["errors", "--volume", "shells:16", "--size", "24", "--config", "base", "--quick", "--blame", "quarter.png"]);
  const page = await open(report("sizes", ["compare.json", "quarter.json"]));
  const titles = await page.$$eval(".pane figcaption", (all) => all.map((each) => each.textContent));
  assert.ok(titles.includes("Blame (of 24 \u00d7 24 pixels)"), titles.join());
  await page.finish();
  // It covers a frame of any size: a place shows the map's value there.
  result("third", ["errors", "--volume", "shells:16", "--size", "32", "--config", "base", "--quick", "--blame", "third.png"]);
  const other = await open(report("thirds", ["compare.json", "third.json"]));
  const map = (await data_of(other)).pictures.find((picture) => picture.role === "blame");
  const canvas = `canvas[data-view="${map.id}"]`;
  const side = await other.$eval(canvas, (element) => element.clientWidth);
  const step = map.width / 32; // of the map, enlarged, for a pixel
  let colours = new Set();
  for (let y = 3; y < 32; y += 4)
    for (let x = 3; x < 32; x += 4) {
      const wanted = pixel_of("third.png", Math.floor((x + 0.5) * step), Math.floor((y + 0.5) * step)).slice(0, 3);
      near(await canvas_pixel(other, canvas, Math.floor(((x + 0.5) / 32) * side), Math.floor(((y + 0.5) / 32) * side)), wanted, `(${x}, ${y}) of the map`);
      colours.add(wanted.join());
    }
  figure("colours of the map at their places", colours.size, "> 1");
  assert.ok(colours.size > 1);
  await other.finish();
});

test("a damaged block is named, not drawn", async () => {
  const text = readFileSync(whole, "utf8");
  save("damaged.html", text.replace(/(id="picture-0">)(.{40})/, (_, id, bytes) => id + [...bytes].reverse().join("")));
  const page = await open(place("damaged.html"), { ready: "error" });
  assert.match(await page.textContent(".broken"), /picture .*golden\.exr/);
  await page.finish([/picture .*golden\.exr/]);
});
