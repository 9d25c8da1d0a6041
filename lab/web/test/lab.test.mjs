// SPDX-License-Identifier: Apache-2.0
// The lab as its users have it: sliders, links, files, undo, cancelled and dead workers, the pixel's story.
import assert from "node:assert/strict";
import { readFileSync, truncateSync } from "node:fs";
import { after, before, test } from "node:test";
import { data, figure, median, metaimage, nifti, nrrd, open, place, psnr, rest, reveal, save, serious, settled, shown_hash, start, stop, type } from "./lab_page.mjs";

before(start);
after(stop);

const small = "#lab?volume=shells:32&config=base&size=128x128";
const hidden = (page, selector) => page.$eval(selector, (element) => element.hidden || element.offsetParent === null);

test("the first picture, and a slider moved by keyboard", async () => {
  const page = await open();
  figure("milliseconds from opening to the first picture", page.first_ms);
  await settled(page);
  const before_ = { hash: await shown_hash(page), psnr: await psnr(page) };
  assert.match(before_.hash, /^[0-9a-f]{16}$/);
  assert.match(before_.psnr, /^\d+\.\d\d/);
  const slider = page.locator('.control[data-name="camera.azimuth"] input[type="range"]');
  await slider.focus();
  const now = await rest(page, () => page.keyboard.press("ArrowRight"));
  assert.equal(now.size, "256x256");
  assert.notEqual(await shown_hash(page), before_.hash);
  assert.match(await page.textContent("#command"), /--azimuth 31/);
  assert.equal(await page.$eval('.control[data-name="camera.azimuth"]', (e) => e.classList.contains("changed")), true);
  await rest(page, () => page.keyboard.press("ArrowLeft"));
  assert.equal(await shown_hash(page), before_.hash);
  await page.finish();
});

test("steps at 128 x 128", async () => {
  const page = await open({ hash: "#lab?volume=shells:64&config=base&size=128x128" });
  const step = async (act) => {
    const frames = Number((await data(page)).frames);
    await act();
    await page.waitForFunction((n) => Number(document.documentElement.dataset.frames) > n, frames);
    const { ms, engineMs } = await data(page);
    return [Number(ms), Number(engineMs)];
  };
  for (const [name, what] of [["camera.azimuth", "camera step"], ["radial.frac_bits", "device step"]]) {
    await reveal(page, name);
    const slider = page.locator(`.control[data-name="${name}"] input[type="range"]`);
    await slider.focus();
    const times = [];
    for (let i = 0; i < 9; ++i) times.push(await step(() => page.keyboard.press("ArrowLeft")));
    figure(`${what} at 128 x 128, shells:64, base, milliseconds, median`, median(times.map(([ms]) => ms)));
    figure(`${what}, of these in the engine`, median(times.map(([, ms]) => ms)));
  }
  await page.finish();
});

test("the address holds the state", async () => {
  const page = await open({ hash: small });
  await rest(page, () => type(page, "camera.azimuth", 77));
  await rest(page, () => type(page, "radial.frac_bits", 7));
  await page.click("#tab-scene");
  await rest(page, () => page.selectOption("#tf", "linear"));
  await page.locator('canvas[data-view="device"]').click({ position: { x: 100, y: 100 } });
  await page.click("#copy-link");
  const link = await page.evaluate(() => window.copied.at(-1));
  const hash = await shown_hash(page);
  const other = await open({ hash: link.slice(link.indexOf("#")) });
  await settled(other);
  assert.equal(await shown_hash(other), hash);
  assert.equal(await other.$eval('.control[data-name="radial.frac_bits"]', (e) => e.classList.contains("changed")), true);
  assert.equal(await other.inputValue("#tf"), "linear");
  assert.equal(await other.getAttribute(".words caption", "data-at"), await page.getAttribute(".words caption", "data-at"));
  await other.finish();
  await page.finish();
});

test("a report's address: a scene, and a configuration with its hash", async () => {
  const address = (scene, more = {}) => `#lab?${new URLSearchParams({ scene, config: "tiny", ...more })}`;
  const scene = 'volume = "shells:32"\n[image]\nwidth = 96\nheight = 80\n[camera]\nazimuth = 75.0\n';
  const page = await open({ hash: address(scene, { config_hash: "0123456789abcdef" }) });
  await settled(page);
  assert.equal((await data(page)).size, "96x80");
  assert.match(await page.textContent("#command"), /--volume shells:32 --size 96x80 --azimuth 75\.0 --engine cmodel --config tiny/);
  assert.match(await page.textContent("#notice"), /configuration tiny has the hash 0123456789abcdef; this one has/);
  await page.finish();
  // Without a hash: no notice. A scene that cannot be read: a notice, and the first picture.
  const plain = await open({ hash: address(scene) });
  await settled(plain);
  assert.equal(await hidden(plain, "#notice"), true);
  await plain.finish();
  const wrong = await open({ hash: address("volume = ") });
  await settled(wrong);
  assert.match(await wrong.textContent("#notice"), /scene:1/);
  assert.match(await shown_hash(wrong), /^[0-9a-f]{16}$/);
  await wrong.finish();
});

test("addresses that name what is not there", async () => {
  for (const [hash, pattern] of [
    ["#lab?volume=nothing:32&config=base&size=128x128", /nothing:32.*known:/],
    ["#lab?volume=/files/mine.nrrd&config=base&size=128x128", /mine\.nrrd: drop it on the page/],
    ["#lab?volume=shells:32&config=other&size=128x128", /other/],
    ["#lab?volume=shells:32&config=base&size=128x128&s.camera.azimuth=east&k.nothing=1", /camera\.azimuth.*number/],
  ]) {
    const page = await open({ hash });
    assert.match(await page.textContent("#error"), pattern);
    if (hash.includes("mine")) {
      await rest(page, () => page.setInputFiles("#file", save("mine.nrrd", nrrd(24))));
    } else {
      await rest(page, () => page.evaluate((link) => void (location.hash = link), small));
    }
    assert.equal(await hidden(page, "#error"), true);
    assert.match(await shown_hash(page), /^[0-9a-f]{16}$/);
    await page.finish();
  }
});

test("settings without effect are greyed, with the reason", async () => {
  const page = await open({ hash: small });
  const fov = '.control[data-name="camera.fov"]';
  assert.equal(await page.isDisabled(`${fov} input[type="number"]`), true);
  assert.match(await page.textContent(`${fov} .why`), /no effect without a perspective camera/);
  await rest(page, () => page.selectOption('.control[data-name="camera.projection"] select', "perspective"));
  assert.equal(await page.isDisabled(`${fov} input[type="number"]`), false);
  await rest(page, () => type(page, "camera.fov", 50));
  const hash = await shown_hash(page);
  await rest(page, () => page.selectOption('.control[data-name="camera.projection"] select', "orthographic"));
  assert.equal(await page.inputValue(`${fov} input[type="number"]`), "50");
  await rest(page, () => page.selectOption('.control[data-name="camera.projection"] select', "perspective"));
  assert.equal(await shown_hash(page), hash, "a greyed setting keeps its value");
  await page.finish();
});

test("device keys: marked, listed, undone and done again, saved and read", async () => {
  const page = await open({ hash: small });
  const first = await shown_hash(page);
  await reveal(page, "sheet.frac_bits");
  await rest(page, () => type(page, "sheet.frac_bits", 8));
  const second = await shown_hash(page);
  assert.notEqual(second, first);
  assert.match(await page.textContent("#differences"), /1 key differs from base.*sheet\.frac_bits: 16 . 8/s);
  await page.locator('canvas[data-view="device"]').focus();
  await rest(page, () => page.keyboard.press("Control+z"));
  assert.equal(await shown_hash(page), first);
  await rest(page, () => page.keyboard.press("Control+Shift+Z"));
  assert.equal(await shown_hash(page), second);
  // A file out and in.
  await page.click("#tab-device");
  await page.$eval('details[data-group="file"]', (details) => (details.open = true));
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-toml")]);
  await download.saveAs(place("device.toml"));
  const toml = readFileSync(place("device.toml"), "utf8");
  assert.match(toml, /frac_bits = 8/);
  await rest(page, () => page.click("#reset-device"));
  assert.equal(await shown_hash(page), first);
  await page.fill("#toml", toml);
  await rest(page, () => page.click("#use-toml"));
  assert.equal(await shown_hash(page), second);
  // An invalid one changes nothing.
  await page.fill("#toml", "lanes = ");
  await page.click("#use-toml");
  await page.waitForFunction(() => !document.querySelector("#device .wrong-line").hidden);
  assert.equal(await shown_hash(page), second);
  await rest(page, () => page.selectOption("#config", "tiny"));
  assert.notEqual(await shown_hash(page), second);
  await page.finish();
});

test("while a slider moves pictures are small, at rest as large as asked for", async () => {
  const page = await open({ hash: "#lab?volume=shells:32&config=base&size=256x200" });
  await settled(page);
  await reveal(page, "camera.azimuth");
  const drawn = page.evaluate(
    () =>
      new Promise((done) => {
        const root = document.documentElement, seen = [];
        new MutationObserver(() => {
          seen.push(`${root.dataset.size} ${root.dataset.draft}`);
          if (root.dataset.settled === "true") done(seen);
        }).observe(root, { attributeFilter: ["data-frames"] });
        const slider = document.querySelector('.control[data-name="camera.azimuth"] input[type="range"]');
        slider.value = String(Number(slider.value) + 20);
        slider.dispatchEvent(new Event("input"));
      }),
  );
  assert.deepEqual(await drawn, ["128x100 true", "256x200 false"]);
  await page.finish();
});

test("of a burst of changes only the newest count", async () => {
  const page = await open({ hash: "#lab?volume=shells:64&config=base&size=256x256" });
  await settled(page);
  const before_ = Number((await data(page)).frames);
  await reveal(page, "camera.azimuth");
  await rest(page, () =>
    page.$eval('.control[data-name="camera.azimuth"] input[type="range"]', (slider) => {
      for (let i = 1; i <= 40; ++i) {
        slider.value = String(Number(slider.value) + 1);
        slider.dispatchEvent(new Event("input"));
      }
      slider.dispatchEvent(new Event("change"));
    }),
  );
  const drawn = Number((await data(page)).frames) - before_;
  figure("frames drawn of 40 changes at once", drawn, "<= 3");
  assert.ok(drawn <= 3);
  assert.match(await page.textContent("#command"), /--azimuth 70/);
  await page.finish();
});

test("errors stand where they belong", async () => {
  const page = await open({ hash: small });
  await type(page, "radial.entries", 3);
  const why = '.control[data-name="radial.entries"] .why';
  await page.waitForFunction((s) => /power of two/.test(document.querySelector(s).textContent), why);
  await rest(page, () => page.click("#undo"));
  assert.equal(await hidden(page, why), true);
  await type(page, "kernel.radius", 99);
  await page.waitForFunction(() => /0\.5\.\.8/.test(document.querySelector('.control[data-name="kernel.radius"] .why').textContent));
  await rest(page, () => page.click("#undo"));
  // What the device cannot do is said at the device; golden is drawn.
  await reveal(page, "method");
  await rest(page, () => page.selectOption('.control[data-name="method"] select', "raycast"));
  assert.match(await page.textContent("#error"), /raycast/);
  assert.deepEqual(await page.$$eval(".frame canvas", (all) => all.map((each) => each.dataset.view)), ["golden"]);
  await rest(page, () => page.click("#undo"));
  assert.deepEqual(await page.$$eval(".frame canvas", (all) => all.map((each) => each.dataset.view)), ["golden", "device", "error"]);
  await page.finish();
});

test("files: good, cut, foreign, empty, huge", async () => {
  const page = await open({ hash: small });
  const before_ = await shown_hash(page);
  const drop = (...paths) => page.setInputFiles("#file", paths);
  let taken = 0, refused = 0;
  const good = async (path, pattern) => {
    await rest(page, () => drop(path));
    assert.match(await page.textContent("#volume option:checked"), pattern);
    assert.match(await shown_hash(page), /^[0-9a-f]{16}$/);
    assert.equal(await hidden(page, "#error"), true, await page.textContent("#error"));
    ++taken;
  };
  const bad = async (path, pattern) => {
    const hash = await shown_hash(page), volume = await page.inputValue("#volume");
    await page.evaluate(() => (document.getElementById("error").textContent = ""));
    await drop(path);
    await page.waitForFunction(() => document.getElementById("error").textContent !== "" && !document.getElementById("error").hidden, null, { timeout: 20_000 });
    const text = await page.textContent("#error");
    assert.match(text, pattern);
    assert.doesNotMatch(text, /\n/);
    assert.equal(await shown_hash(page), hash);
    assert.equal(await page.inputValue("#volume"), volume);
    ++refused;
  };
  const whole = nrrd(24);
  await good(save("ball.nrrd", whole), /ball\.nrrd/);
  await bad(save("cut.nrrd", whole.subarray(0, whole.length / 2)), /cut\.nrrd/);
  await good(save("ball.nii", nifti(24)), /ball\.nii/);
  const gz = nifti(24, true);
  await good(save("ball.nii.gz", gz), /ball\.nii\.gz/);
  await bad(save("cut.nii.gz", gz.subarray(0, gz.length / 2)), /cut\.nii\.gz/);
  await good(save("ball.mha", metaimage(24)), /ball\.mha/);
  await bad(save("garbage.nii", Buffer.from("no volume at all, whatever its name is")), /garbage\.nii/);
  await bad(save("picture.jpg", Buffer.from("x")), /not a volume/);
  await bad(save("empty.nrrd", Buffer.alloc(0)), /empty/);
  save("huge.nrrd", nrrd(8));
  truncateSync(place("huge.nrrd"), 500_000_000);
  await bad(place("huge.nrrd"), /too large for a page/);
  // A real drop, with a transfer function; then a configuration.
  const hash = await shown_hash(page);
  await rest(page, () =>
    page.evaluate(() => {
      const transfer = new DataTransfer();
      transfer.items.add(new File(["points = [{at = 0.1, colour = [1.0, 0.2, 0.1], opacity = 0.0}, {at = 0.9, colour = [0.1, 0.9, 1.0], opacity = 0.6}]\n"], "mine.toml"));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }),
  );
  assert.notEqual(await shown_hash(page), hash);
  await bad(save("wrong.toml", "points = [{at = 0.1}]\n"), /./);
  await bad(save("wrong_device.toml", "[array]\nlanes = 3\n"), /./);
  await rest(page, () => page.selectOption("#volume", "shells:32"));
  await rest(page, () => page.selectOption("#tf", ""));
  assert.equal(await shown_hash(page), before_);
  assert.equal(taken, 4);
  figure("files taken", taken, "4");
  assert.equal(refused, 8);
  figure("files refused in one line", refused, "8");
  await page.finish();
});

test("files of one name, several at once, and what a drop does not change", async () => {
  const page = await open({ hash: small });
  const file = (name, buffer) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(buffer) });
  const drop = (...files) => page.setInputFiles("#file", files);
  const said = async (files, pattern) => {
    await page.evaluate(() => (document.getElementById("error").textContent = ""));
    await drop(...files);
    await page.waitForFunction((text) => new RegExp(text).test(document.getElementById("error").textContent), pattern.source);
  };
  const chosen = () => page.textContent("#volume option:checked");
  const hash_of = async (...files) => (await rest(page, () => drop(...files)), shown_hash(page));
  const large = await hash_of(file("large.nrrd", nrrd(24))), other = await hash_of(file("other.nrrd", nrrd(20)));
  assert.notEqual(large, other);
  // A name is given again: after a refused drop, for the data of two headers, beside another volume.
  await said([file("d.nrrd", nrrd(24)), file("bad.toml", "points = [{at = 0.1}]")], /./);
  assert.equal(await hash_of(file("d.nrrd", nrrd(20))), other);
  const header = (n) => `ObjectType = Image\nNDims = 3\nDimSize = ${n} ${n} ${n}\nElementType = MET_UCHAR\nElementDataFile = the data.dat\n`;
  const body = (n) => nrrd(n).subarray(-(n ** 3));
  assert.equal(await hash_of(file("the data.dat", body(24)), file("a 1.mhd", header(24))), large);
  assert.equal(await chosen(), "a 1.mhd");
  assert.equal(await hash_of(file("the data.dat", body(20)), file("b.mhd", header(20))), other);
  const choose = async (name) => (await rest(page, () => page.selectOption("#volume", { label: name })), shown_hash(page));
  assert.equal(await choose("a 1.mhd"), large);
  assert.match(await page.textContent("#command"), /--volume 'a 1\.mhd'/);
  assert.equal(await hash_of(file("i.nrrd", nrrd(20)), file("second.nrrd", nrrd(24))), other);
  assert.equal(await choose("second.nrrd"), large);
  // A configuration is taken with a scene, or the scene is not taken.
  const state = [await shown_hash(page), await chosen()];
  await said([file("bad.toml", "[radial]\nfrac_bits = 6\n"), file("late.nrrd", nrrd(20))], /./);
  assert.deepEqual([await shown_hash(page), await chosen()], state);
  await rest(page, () => page.click("#undo"));
  await page.click("#tab-device");
  await hash_of(file("mine.toml", readFileSync(`${process.env.CONFIGS}/small.toml`)), file("third.nrrd", nrrd(20)));
  assert.match(await page.textContent("#command"), /--volume third\.nrrd .*--config mine\.toml/);
  // After an error the old figures are marked; a link says what is not followed.
  await reveal(page, "camera.zoom");
  await type(page, "camera.zoom", 1e9);
  await page.waitForFunction(() => document.documentElement.dataset.stale === "true");
  assert.match(await page.textContent("#error"), /earlier state/);
  await rest(page, () => page.click("#undo"));
  assert.equal((await data(page)).stale, "false");
  await page.finish();
  const linked = await open({ hash: `${small.replace("128x128", "0x99")}&k.nonsense=3` });
  assert.match(await linked.textContent("#notice"), /Not followed in this link: k\.nonsense=3, size=0x99/);
  await linked.finish();
});

test("3-D Gaussians: built in and dropped", async () => {
  const page = await open({ hash: small });
  const volume = await shown_hash(page);
  await page.click("#tab-scene");
  await rest(page, () => page.selectOption("#volume", "gaussians shells:500"));
  const shells = await shown_hash(page);
  assert.notEqual(shells, volume);
  assert.equal(await page.inputValue("#config"), "ellipse");
  assert.match(await page.textContent("#command"), /--gaussians shells:500 --size 128 .*--engine cmodel --config ellipse --set composite\.every_sample=1/);
  assert.equal(await hidden(page, "#error"), true, await page.textContent("#error"));
  assert.match(await psnr(page), /^\d\d/);
  // Settings of volumes are greyed, with the reason; Gaussians have settings of their own.
  assert.equal(await page.isDisabled("#tf"), true);
  assert.match(await page.textContent('.control[data-name="slabs.width"] .why'), /no effect on 3-D Gaussians/);
  await rest(page, () => type(page, "gaussians.cutoff", 2));
  assert.notEqual(await shown_hash(page), shells);
  assert.match(await page.textContent("#command"), /--cutoff 2/);
  await rest(page, () => page.click("#undo"));
  await page.waitForFunction(() => /\d/.test(document.getElementById("cycles-actual")?.textContent ?? ""), null, { timeout: 60_000 });
  // The link carries them; it follows a change after a moment.
  await page.waitForFunction(() => !location.hash.includes("cutoff"));
  const other = await open({ hash: await page.evaluate(() => location.hash) });
  await settled(other);
  assert.equal(await shown_hash(other), shells);
  await other.finish();
  // Files: a .splat of three Gaussians, one cut, and an empty .ply.
  const splat = Buffer.alloc(96);
  for (let i = 0; i < 3; ++i) {
    [i, i / 2, 0, 0.4, 0.3, 0.2].forEach((value, k) => splat.writeFloatLE(value, 32 * i + 4 * k));
    splat.set([200, 90 * i, 50, 220, 255, 128, 128, 128], 32 * i + 24);
  }
  await rest(page, () => page.setInputFiles("#file", save("three.splat", splat)));
  assert.match(await page.textContent("#volume option:checked"), /three\.splat/);
  const three = await shown_hash(page);
  assert.notEqual(three, shells);
  for (const [name, bytes] of [["cut.splat", splat.subarray(0, 70)], ["wrong.ply", Buffer.from("ply\nformat ascii 1.0\nend_header\n")]]) {
    await page.evaluate(() => (document.getElementById("error").textContent = ""));
    await page.setInputFiles("#file", save(name, bytes));
    await page.waitForFunction((each) => document.getElementById("error").textContent.includes(each), name);
    assert.equal(await shown_hash(page), three);
  }
  await rest(page, () => page.selectOption("#volume", "shells:32"));
  assert.equal(await shown_hash(page), volume);
  await page.finish();
});

test("a worker that dies is started again, with the files it had", async () => {
  const page = await open({ hash: small });
  await rest(page, () => page.setInputFiles("#file", save("ball.nrrd", nrrd(24))));
  await page.waitForTimeout(1500); // cycles
  for (const worker of page.workers()) await worker.evaluate(() => void setTimeout(() => { throw new Error("killed by the test"); }));
  await page.waitForFunction(() => !document.getElementById("notice").hidden);
  assert.match(await page.textContent("#notice"), /stopped .*killed by the test.* started again/);
  const hash = await shown_hash(page);
  await rest(page, () => type(page, "camera.azimuth", 60));
  assert.notEqual(await shown_hash(page), hash);
  assert.equal(page.workers().length, 2);
  await page.finish();
});

test("long work can be cancelled", async () => {
  const page = await open({ hash: small });
  const hash = await shown_hash(page);
  await page.selectOption("#volume", "shells:128");
  await page.fill("#width", "1024");
  await page.fill("#height", "1024");
  await page.press("#height", "Tab");
  await page.waitForSelector(".working:not([hidden]) .cancel", { timeout: 30_000 });
  await page.click(".working:not([hidden]) .cancel");
  await page.waitForFunction(() => /Cancelled/.test(document.getElementById("notice").textContent));
  await page.click("#undo");
  await page.click("#undo");
  while (!(await page.isDisabled("#undo"))) await page.click("#undo");
  await page.waitForFunction((wanted) => document.getElementById("words-hash").textContent === wanted, hash, { timeout: 60_000 });
  await page.finish();
});

test("a pixel's story and the error by step of 3-D Gaussians", async () => {
  const page = await open({ hash: small });
  await page.click("#tab-scene");
  await rest(page, () => page.selectOption("#volume", "gaussians shells:500"));
  await page.locator('canvas[data-view="device"]').click({ position: { x: 150, y: 130 } });
  await page.click("#pixel summary");
  await page.waitForSelector("#pixel-lead", { timeout: 60_000 });
  const lead = await page.textContent("#pixel-lead");
  const rows = page.locator('#pixel [aria-label="Gaussians of the pixel"] tbody tr');
  assert.match(lead, new RegExp(`: ${await rows.count()} Gaussians`));
  await rows.nth(1).click();
  const number = (await rows.nth(1).locator("td,th").first().textContent())?.trim();
  assert.equal(await page.textContent("#sheet-splats"), `Gaussian ${number}`);
  await page.click("#ask-errors");
  await page.waitForSelector("#errors table", { timeout: 120_000 });
  assert.equal((await page.$$("#errors tbody tr")).length, 11);
  figure("Gaussians at the pixel", await rows.count(), "> 1");
  assert.ok((await rows.count()) > 1);
  await page.finish();
});

test("the pixel's story, the error by step, and the configurations tried", async () => {
  const page = await open({ hash: "#lab?volume=shells:32&config=base&size=64x64&s.opacity_scale=9" });
  await page.locator('canvas[data-view="device"]').click({ position: { x: 150, y: 130 } });
  await page.click("#pixel summary");
  await page.waitForSelector("#pixel-lead", { timeout: 60_000 });
  const at = await page.getAttribute(".words caption", "data-at");
  assert.equal(await page.getAttribute("#pixel-lead", "data-pixel"), at);
  assert.ok((await page.$$("#pixel .sheets tbody tr")).length > 2);
  const title = await page.textContent("#sheet-splats");
  await page.locator('#pixel [aria-label="Sheets of the pixel"] tbody tr').nth(3).click();
  assert.notEqual(await page.textContent("#sheet-splats"), title);
  // Word and value of the first sum agree with its scale.
  const sums = await page.$$eval('#pixel [aria-label="Sheets of the pixel"] tbody tr', (rows) => rows.map((row) => row.cells[2].querySelector(".value")?.title ?? "").filter((title) => title.includes("word")));
  assert.ok(sums.length > 2);
  for (const sum of sums) {
    const [, value, word] = /device ([\d.e-]+), word (\d+)/.exec(sum);
    assert.equal(Number(word), Number(value) * 65536);
  }
  // Which step errs.
  await page.click("#ask-errors");
  await page.waitForSelector("#errors table", { timeout: 120_000 });
  assert.ok(await page.$('canvas[data-view="blame"]'));
  // Which pixels terminate: the map says the same as the story and the figure.
  await page.click("#ask-terminated");
  await page.waitForSelector("#terminated-pixels", { timeout: 60_000 });
  await page.waitForSelector('canvas[data-view="terminated"]');
  assert.ok(await page.$('canvas[data-view="blame"]'), "both maps are shown");
  assert.match(await page.textContent("#terminated-pixels"), /of 4.096 pixels terminate early/);
  assert.match(await page.textContent('[data-note="terminated"]'), /^Yellow: sheet \d+, the first\. Violet: sheet \d+, the last/);
  // Trials, and back.
  const first = await shown_hash(page);
  await page.click("#tab-device");
  await rest(page, () => page.selectOption("#config", "tiny"));
  await rest(page, () => page.selectOption("#config", "compact"));
  assert.equal((await page.$$("#tried tbody tr")).length, 3);
  await page.waitForFunction(() => /\d/.test(document.getElementById("cycles-actual")?.textContent ?? ""), null, { timeout: 60_000 });
  assert.match(await page.textContent("#bytes"), /\d/);
  await rest(page, () => page.locator("#tried tbody tr", { hasText: "base" }).click());
  assert.equal(await shown_hash(page), first);
  await page.finish();
});

test("the transfer function's editor", async () => {
  const page = await open({ hash: small });
  await page.click("#edit-tf");
  await page.waitForSelector(".tf-point");
  const hash = await shown_hash(page);
  await page.locator('.tf-point[data-point="0"]').focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press("PageDown");
  await rest(page, () => page.keyboard.press("Shift+ArrowUp"));
  const second = await shown_hash(page);
  assert.notEqual(second, hash);
  await rest(page, () => page.keyboard.press("Shift+ArrowDown"));
  assert.equal(await shown_hash(page), hash, "the preset as a file of its own, with its shading");
  await rest(page, () => page.keyboard.press("Shift+ArrowUp"));
  assert.equal(await shown_hash(page), second);
  await rest(page, () => page.$eval("#tf-colour", (input) => ((input.value = "#00ff00"), input.dispatchEvent(new Event("change")))));
  assert.notEqual(await shown_hash(page), second);
  const points = (await page.$$(".tf-point")).length;
  await rest(page, () => page.click("#tf-add"));
  assert.equal((await page.$$(".tf-point")).length, points + 1);
  const box = await page.locator('.tf-point[data-point="2"]').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  // Held still for so long that the picture comes before the release, which asks for no other one.
  await page.mouse.down();
  await rest(page, () => page.mouse.move(box.x + 8, box.y - 40, { steps: 3 }));
  await page.mouse.up();
  await settled(page);
  await page.waitForSelector("#cycles:not(.stale)");
  const saved_hash = await shown_hash(page);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#tf-save")]);
  await download.saveAs(place("saved.toml"));
  assert.match(readFileSync(place("saved.toml"), "utf8"), /domain = "value"/);
  // Undone to the end, the editor shows the preset's points again.
  const many = (await page.$$(".tf-point")).length;
  while (!(await page.isDisabled("#undo"))) await rest(page, () => page.click("#undo"));
  assert.equal(await shown_hash(page), hash);
  await page.waitForFunction((n) => document.querySelectorAll(".tf-point").length === n, points);
  while (!(await page.isDisabled("#redo"))) await rest(page, () => page.click("#redo"));
  await page.waitForFunction((n) => document.querySelectorAll(".tf-point").length === n, many);
  // The link carries it.
  assert.equal(await shown_hash(page), saved_hash);
  await page.click("#copy-link");
  const link = await page.evaluate(() => window.copied.at(-1));
  const other = await open({ hash: link.slice(link.indexOf("#")) });
  assert.equal(await shown_hash(other), saved_hash);
  await other.finish();
  await page.finish();
});

test("turned by dragging and by keys", async () => {
  const page = await open({ hash: small });
  const hash = await shown_hash(page);
  const box = await page.locator('canvas[data-view="golden"]').boundingBox();
  await page.mouse.move(box.x + 100, box.y + 100);
  await rest(page, async () => {
    await page.mouse.down();
    await page.mouse.move(box.x + 160, box.y + 110, { steps: 5 });
    await page.mouse.up();
  });
  const turned = await shown_hash(page);
  assert.notEqual(turned, hash);
  await page.locator('canvas[data-view="golden"]').focus();
  await rest(page, () => page.keyboard.press("ArrowUp"));
  assert.notEqual(await shown_hash(page), turned);
  // The picture keeps the focus.
  const focus = () => page.evaluate(() => document.activeElement.dataset.view);
  assert.equal(await focus(), "golden");
  await rest(page, () => page.keyboard.press("+"));
  assert.match(await page.textContent("#command"), /--zoom 1\.1/);
  assert.equal(await focus(), "golden");
  // Turned off, keys move the pixel.
  await page.keyboard.press("t");
  await page.keyboard.press("ArrowRight");
  await page.waitForFunction(() => document.querySelector(".words caption").dataset.at === "65,64");
  await rest(page, () => page.click("#undo"));
  await page.finish();
});

for (const theme of ["light", "dark"])
  for (const width of [390, 1280])
    test(`${width} pixels, ${theme}: nothing sticks out, everything has a name, axe-core finds nothing serious`, async () => {
      const page = await open({ width, theme, hash: small, touch: width === 390 });
      for (const details of await page.$$("details")) await details.evaluate((element) => (element.open = true));
      await page.waitForSelector(".tf-point");
      await page.waitForFunction(() => /\d/.test(document.getElementById("cycles-actual")?.textContent ?? ""), null, { timeout: 60_000 });
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.ok(wide <= 0, `${wide} pixels stick out`);
      const nameless = await page.$$eval("input, select, textarea, button, summary", (all) =>
        all
          .filter((each) => !(each.getAttribute("aria-label") || each.textContent.trim() || each.labels?.length))
          .map((each) => each.outerHTML.slice(0, 80)),
      );
      assert.deepEqual(nameless, []);
      const twice = await page.evaluate(() => {
        const ids = [...document.querySelectorAll("[id]")].map((each) => each.id);
        return ids.filter((id, i) => ids.indexOf(id) !== i);
      });
      assert.deepEqual(twice, []);
      const found = [];
      for (const tab of ["scene", "device"]) {
        await page.click(`#tab-${tab}`);
        found.push(...(await serious(page)));
      }
      figure(`serious findings of axe-core, ${width} pixels, ${theme}`, found.length, "0");
      assert.deepEqual(found, []);
      await page.finish();
    });
