// SPDX-License-Identifier: Apache-2.0
// The panels in a browser: their numbers are the results', their drawings add up, tables and plots work.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { compare_figures, data_of, fastsplat, figure, here, open, place, report, result, save, shown_number, start, stop } from "./browser.mjs";
import { brute_front, sample_plan } from "./sample_plan.mjs";

const scene = ["--volume", "shells:24", "--size", "64", "--azimuth", "40"];
const mismatch = JSON.parse(readFileSync(join(here, "samples/verify-mismatch.json"), "utf8"));
const closure = JSON.parse(readFileSync(join(here, "samples/closure.json"), "utf8"));
let all = ""; // a report of every verb

before(async () => {
  result("golden", ["render", ...scene, "--engine", "golden", "-o", "golden.exr"]);
  result("cmodel", ["render", ...scene, "--engine", "cmodel", "-o", "cmodel.exr"]);
  result("compare", ["compare", "golden.exr", "cmodel.exr"]);
  result("strict", ["compare", "golden.exr", "cmodel.exr", "--min-psnr", "120"], [0, 1]);
  result("same", ["compare", "golden.exr", "golden.exr"]);
  result("errors", ["errors", ...scene]);
  fastsplat(["gaussians", "convert", "shells:300", "shells.spz", "--quiet"]);
  result("file", ["errors", "file", "shells:300", "shells.spz", "--size", "48"]);
  result("floats", ["errors", ...scene, "--formats", "fp16,fp32", "--quick"]);
  result("bound", ["errors", "bound", ...scene]);
  result("ranges", ["errors", "ranges", ...scene]);
  result("propose", ["errors", "propose", "--target", "psnr>=45", "--target", "fps>=500", "--clock", "100", "--volume", "shells:12", "--size", "24"]);
  result("cycles", ["cycles", ...scene.slice(0, 2), "--size", "128", "--config", "small", "--timeline"]);
  result("devices", ["cycles", ...scene, "--config", "small", "--devices", "1,2,4", "--bytes-per-cycle", "8"]);
  result("family", ["family", "--entries", "256"]);
  result("verify", ["verify", "--random", "400", "--seeds", "5", "--config", "tiny", "--coverage", "book.json"]);
  save("spec.toml", 'name = "lanes"\nkind = ["compare", "cycles"]\n[constants]\nvolume = "shells:12"\nsize = 24\n[axes]\n"sheet.frac_bits" = [8, 12, 16]\n"snap.phases" = [8, 64]\n');
  fastsplat(["plan", "make", "spec.toml", "-o", "cases.json", "--quiet"]);
  fastsplat(["plan", "run", "cases.json", "--results", "cases", "--quiet"]);
  fastsplat(["plan", "merge", "cases.json", "--results", "cases", "-o", "merged.json", "--quiet"]);
  // As in the demo: another size for the steps, culling, classified by pixel; files by their whole paths.
  result("quick", ["errors", ...scene.slice(0, 2), "--size", "32", "--quick"]);
  result("culling", ["cycles", ...scene.slice(0, 2), "--size", "48", "--cull-table"]);
  const post = [...scene.slice(0, 2), "--size", "40", "--classify", "post"];
  result("post-golden", ["render", ...post, "--engine", "golden", "-o", place("post-golden.exr")]);
  result("post-cmodel", ["render", ...post, "--engine", "cmodel", "--config", "fine", "--set", "classify.segment_bits=9", "-o", place("post-cmodel.exr")]);
  result("post-compare", ["compare", place("post-golden.exr"), place("post-cmodel.exr")]);
  result("rough-render", ["render", ...scene, "--engine", "cmodel", "--set", "sheet.frac_bits=8", "-o", "rough.exr"]);
  result("rough", ["compare", "golden.exr", "rough.exr"]); // below the floor
  result("gaussians", ["render", "--gaussians", "shells:40", "--size", "32", "-o", "gaussians.exr"]);
  fastsplat(["stream", "record", ...scene, "--config", "base", "-o", place("s.fss"), "--json", "record.json", "--quiet"]);
  result("replay", ["stream", "replay", place("s.fss"), "-o", "replay.exr"]);
  save("mismatch.json", mismatch);
  save("closure.json", closure);
  save("plan.json", sample_plan(240));
  save("long.json", sample_plan(2000));
  const names = ["compare", "strict", "same", "errors", "floats", "file", "bound", "ranges", "propose", "cycles", "devices", "family", "merged", "plan", "verify", "mismatch", "closure", "book", "golden", "cmodel", "quick", "culling", "post-compare", "post-golden", "post-cmodel", "gaussians", "record", "replay", "rough"];
  all = report("all", names.map((name) => `${name}.json`));
  await start();
});
after(stop);

test("every number of every panel is that of its result", async () => {
  const page = await open(all);
  const panels = await page.$$eval("section.panel", (sections) => sections.map((section) => ({ name: section.dataset.panel, id: section.id })));
  const least = { compare: 12, errors: 90, "errors-file": 60, bound: 20, ranges: 80, propose: 30, cycles: 10, family: 300, plan: 100, verify: 20, closure: 50, coverage: 4, runs: 8 };
  const seen = {};
  for (const { name, id } of panels) {
    if (!(name in least)) continue;
    const compared = await compare_figures(page, `#${id}`);
    seen[name] = Math.max(seen[name] ?? 0, compared);
  }
  for (const [name, limit] of Object.entries(least)) {
    figure(`numbers of ${name} compared`, seen[name] ?? 0, `>= ${limit}`);
    assert.ok((seen[name] ?? 0) >= limit, name);
  }
  assert.equal(await page.locator("section[data-panel=result]").count(), 0, "a result that no panel draws");
  const { results } = await data_of(page);
  // Ranges of any scene: the words of the program's own text.
  const ranges = results.findIndex(({ verb }) => verb === "errors ranges");
  const verdicts = await page.$$eval(`#ranges-${ranges} table[aria-label="Ranges of any scene"] tbody td:last-child`, (all) => all.map((each) => each.textContent));
  figure("verdicts of derived ranges compared", verdicts.length, ">= 10");
  assert.ok(verdicts.length >= 10);
  assert.deepEqual(verdicts, results[ranges].derived.map((each) => (each.verdict === "wasteful" ? `${each.unused_head_bits} unused` : each.verdict)));
  // Each can be made again: its command is in a button of its panel.
  const buttons = await page.$$eval("section.panel button[data-command]", (all) => all.map((each) => each.dataset.command));
  const commands = results.map((each) => each.command).filter(Boolean);
  for (const command of commands) assert.ok(buttons.some((button) => button.split("\n").includes(command)), `no button copies ${command}`);
  figure("commands that a button copies", commands.length, ">= 12");
  assert.ok(commands.length >= 12);
  await page.finish();
});

const of_panel = (page, id) => page.$eval(`#${id} h2 .of`, (each) => each.textContent);

test("title, header and every panel's heading say of which scan, configuration and size", async () => {
  const page = await open(report("demo", ["compare", "quick", "cycles", "culling", "post-compare", "cmodel", "golden"].map((name) => `${name}.json`)));
  const main = "shells:24, configuration base, 64 \u00d7 64 pixels";
  assert.equal(await page.title(), `\u2713 Pass: ${main}: FastSplat report`);
  assert.equal(await page.textContent("h1"), `FastSplat report: ${main}`);
  const wanted = {
    "compare-0": main,
    "errors-1": "shells:24, configuration base, 32 \u00d7 32 pixels",
    "cycles-2": "shells:24, configuration small, 128 \u00d7 128 pixels",
    "cycles-3": "shells:24, configuration base, 48 \u00d7 48 pixels",
    "compare-4": "shells:24, classified by pixel, configuration fine+classify.segment_bits=9, 40 \u00d7 40 pixels",
    "runs-5": main,
  };
  for (const [id, text] of Object.entries(wanted)) assert.equal(await of_panel(page, id), text);
  // Values that differ from the verdict's stand out, in the panel and in the header.
  assert.deepEqual(await page.$$eval("#errors-1 h2 strong", (all) => all.map((each) => each.textContent)), ["32 \u00d7 32 pixels"]);
  assert.match(await page.textContent("#top .others"), /32 \u00d7 32 pixels: Error by step/);
  figure("headings compared", Object.keys(wanted).length, "> 0");
  await page.finish();
  const every = await open(all);
  const panels = await every.$$eval("section.panel", (sections) => sections.map((section) => ({ id: section.id, of: section.querySelector("h2 .of").textContent, about: section.querySelector(".about")?.textContent ?? "" })));
  const without_size = /^(family|verify|closure|coverage)-/;
  for (const { id, of, about } of panels) {
    assert.match(of, without_size.test(id) ? /\w/ : /\d+ \u00d7 \d+ pixels|\d+ (sizes|cases)/, id);
    assert.match(about, /^[A-Z].{20,}\.$/, `${id}: a sentence of what it shows`);
  }
  figure("panels with a heading and a sentence", panels.length, ">= 20");
  assert.ok(panels.length >= 20);
  await every.finish();
});

test("a column or a key figure without any value is not drawn", async () => {
  const page = await open(all);
  const { results } = await data_of(page);
  const [whole, quick] = ["errors", "quick"].map((name) => results.findIndex((each) => each.verb === "errors" && /--quick/.test(each.command) === (name === "quick")));
  const heads = (index) => page.$$eval(`#errors-${index} thead th`, (all) => all.map((each) => each.textContent));
  assert.ok((await heads(whole)).some((text) => text.startsWith("Alone")) && (await heads(whole)).some((text) => text.startsWith("Left out")));
  assert.ok(!(await heads(quick)).some((text) => /^(Alone|Left out)/.test(text)), (await heads(quick)).join());
  assert.match(await page.textContent(`#errors-${quick}`), /not measured \(--quick\)/);
  const found = await page.evaluate(() => {
    const empty = [];
    let columns = 0;
    for (const table of document.querySelectorAll("section.panel .table table")) {
      const rows = [...table.querySelectorAll("tbody tr[aria-rowindex]")];
      if (!table.tHead || rows.length < Number(table.getAttribute("aria-rowcount")) - 1) continue; // long: not all rows are in the page
      [...table.tHead.rows[0].cells].forEach((head, i) => {
        ++columns;
        if (rows.every((row) => row.cells[i].textContent.trim() === "\u2013")) empty.push(`${table.getAttribute("aria-label")}: ${head.textContent}`);
      });
    }
    for (const tile of document.querySelectorAll("dl.tiles > div")) if (tile.querySelector("dd").textContent.startsWith("\u2013")) empty.push(tile.textContent);
    return { empty, columns };
  });
  assert.deepEqual(found.empty, []);
  figure("columns looked at", found.columns, ">= 100");
  assert.ok(found.columns >= 100);
  await page.finish();
});

test("culling: its rows are the result's, and the best is named", async () => {
  const page = await open(all);
  const { results } = await data_of(page);
  const index = results.findIndex((each) => each.cull_table);
  const section = page.locator(`#cycles-${index}`);
  const rows = results[index].cull_table;
  assert.equal(await section.locator("table[aria-label=Culling] tbody tr").count(), rows.length);
  assert.ok((await compare_figures(page, `#cycles-${index} table[aria-label=Culling]`)) >= 8 * rows.length);
  const best = rows.reduce((least, row) => (row.cycles < least.cycles ? row : least));
  const shown = await section.locator("h3:text('Occlusion culling') + p").textContent();
  if (best.cull_map === "off") assert.match(shown, /saves no cycles/);
  else assert.match(shown, new RegExp(`^by ${best.cull_map}, ${best.fetch ? "fetched" : "all sent"}: ${best.times_fewer.toFixed(2)} times fewer`));
  figure("rows of the culling table", rows.length, ">= 5");
  assert.ok(rows.length >= 5);
  await page.finish();
});

test("floor, limits and cost have their words and units", async () => {
  const page = await open(all);
  const { results } = await data_of(page);
  let better = 0, worse = 0, costs = 0;
  for (const [index, each] of results.entries()) {
    const text = (await page.locator(`#${each.schema === "fastsplat.compare/1" ? "compare" : (each.verb ?? "").split(" ").pop()}-${index}`).first().textContent({ timeout: 2000 }).catch(() => "")) ?? "";
    if (each.schema === "fastsplat.compare/1" && !each.identical) {
      assert.match(text, /The floor, [\d.]+\sdB, is no limit: it is what the first picture would lose if it were only rounded to 8 bits\./);
      assert.equal(/stored in steps finer than 8 bits/.test(text), each.psnr_db > each.floor.psnr_db, `${each.psnr_db} over ${each.floor.psnr_db}`);
      each.psnr_db > each.floor.psnr_db ? ++better : ++worse;
      for (const name of await page.$$eval(`#compare-${index} table[aria-label=Limits] tbody td:first-child`, (all) => all.map((cell) => cell.textContent))) assert.match(name, /^(PSNR in dB|worst in LSB|values|not finite), at (least|most)$/);
    }
    if (each.remedy || each.cost_from) {
      assert.match(text, /\d\sfull adders/, each.verb);
      ++costs;
    }
  }
  figure("compares above and below the floor", `${better} and ${worse}`, "> 0 both");
  figure("costs with a unit", costs, "> 0");
  assert.ok(better > 0 && worse > 0 && costs > 0);
  await page.finish();
});

test("no folder of the machine is in the page", async () => {
  const folder = place("x").split("/").at(-2);
  const given = ["post-compare", "post-golden", "post-cmodel", "record"].filter((name) => readFileSync(place(`${name}.json`), "utf8").includes(folder));
  const page_text = readFileSync(all, "utf8");
  figure("results that name the folder", given.length, "4");
  assert.equal(given.length, 4);
  assert.equal(page_text.split(folder).length - 1, 0, "the page names it, too");
  const page = await open(all);
  const { results } = await data_of(page);
  const of = results.find((each) => each.test?.file === "post-cmodel.exr");
  assert.equal(of.command, "fastsplat compare post-golden.exr post-cmodel.exr");
  await page.finish();
});

/** Rows of the waterfall in `section`: bars' ends in pixels, numbers as shown. */
function waterfall(page, section, title) {
  return page.$eval(
    section,
    (root, wanted) => {
      const frame = [...root.querySelectorAll("figure")].find((each) => each.querySelector("strong").textContent.startsWith(wanted));
      const bars = [...frame.querySelectorAll("rect")].map((bar) => ({ x: Number(bar.getAttribute("x")), end: Number(bar.getAttribute("x")) + Number(bar.getAttribute("width")) }));
      const shown = [...frame.querySelectorAll("svg > text.tick")].filter((each) => each.getAttribute("text-anchor") === "end" && Number(each.getAttribute("x")) > 300).map((each) => each.textContent);
      return { bars, shown: shown.slice(-bars.length - 1).filter((text) => /\d/.test(text)) };
    },
    title,
  );
}

test("waterfalls add up, in numbers and in pixels", async () => {
  const page = await open(all);
  const { results } = await data_of(page);
  const index = results.findIndex((each) => each.verb === "cycles");
  const { bars, shown } = await waterfall(page, `#cycles-${index}`, "Ideal");
  const numbers = shown.map((text) => shown_number(text).value);
  const actual = numbers.pop();
  assert.equal(numbers.reduce((sum, value) => sum + value, 0), actual);
  assert.equal(actual, results[index].cycles.actual);
  const last = bars.pop();
  for (let i = 1; i < bars.length; ++i) assert.ok(Math.abs(bars[i].x - bars[i - 1].end) < 1.5, `bar ${i} begins at ${bars[i].x}, the one before ended at ${bars[i - 1].end}`);
  assert.ok(Math.abs(last.end - bars.at(-1).end) < 1.5, "the total ends where the last part ends");
  figure("causes of cycles that add up to", actual);
  const errors = results.findIndex((each) => each.verb === "errors");
  const steps = await waterfall(page, `#errors-${errors}`, "Steps");
  const shares = steps.shown.map((text) => shown_number(text).value);
  const total = shares.pop();
  const sum = shares.reduce((a, b) => a + b, 0);
  figure("sum of the steps' shares as shown", sum.toFixed(1), "100 +- 1");
  assert.ok(Math.abs(total - 100) < 0.11 && Math.abs(sum - 100) <= 1);
  await page.finish();
});

test("a failing result says so, with its stream and the command that shows it again", async () => {
  const page = await open(all);
  assert.match(await page.textContent("#top .mark"), /Error/, "a case of the plan broke");
  const section = page.locator("section[data-panel=verify]");
  assert.match(await section.locator(".lead .mark").textContent(), /Fail/);
  const text = await section.textContent();
  for (const part of [mismatch.failure.first, mismatch.failure.smallest, mismatch.failure.operands]) assert.ok(text.includes(part), part);
  await section.locator("button.copy", { hasText: "Copy" }).first().waitFor();
  await section.locator(`button[data-command="${mismatch.failure.replay}"]`).click();
  assert.deepEqual(await page.evaluate(() => window.copied), [mismatch.failure.replay]);
  assert.match(await page.textContent("#said"), /copied/);
  assert.equal(await section.locator("svg rect[fill='var(--c3)']").count(), 1, "the failed seed's column");
  await page.finish();
});

test("an open closure: what is open, each testpoint's bins and tests, the source", async () => {
  const page = await open(report("closure", ["closure.json"]));
  assert.match(await page.textContent("#top .verdict"), /open in 5 places/);
  const section = page.locator("section[data-panel=closure]");
  const rows = (label) => section.locator(`table[aria-label="${label}"] tbody tr`);
  const findings = [...closure.open.campaigns, ...closure.open.testpoints, ...closure.open.lines];
  assert.deepEqual(await rows("What is open").locator("td:nth-child(2)").allTextContents(), findings);
  const bins = closure.testpoints.flatMap((point) => point.configurations.flatMap((on) => Object.entries(on.hits).map(([name, hits]) => ({ point: point.name, text: `${on.config} ${name}`, hits }))));
  const listed = async () => (await rows("Bins").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)))).map(([point, config, name, hits]) => ({ point, text: `${config} ${name}`, hits: shown_number(hits).value }));
  const same = (a, b) => assert.deepEqual([...a].sort((x, y) => (x.point + x.text < y.point + y.text ? -1 : 1)), [...b].sort((x, y) => (x.point + x.text < y.point + y.text ? -1 : 1)));
  const first = await listed();
  same(first, bins);
  assert.equal(first[0].hits, 0, "bins that were never hit come first");
  assert.deepEqual(await rows("Testpoints").locator("td:nth-child(1)").allTextContents(), closure.testpoints.map((point) => point.name));
  // With the keyboard: the second testpoint, its bins and tests only.
  await rows("Testpoints").first().focus();
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  const point = closure.testpoints[1];
  same(await listed(), bins.filter((bin) => bin.point === point.name));
  assert.deepEqual(await rows("Tests").locator("code").allTextContents(), point.tests.map((test) => test.test));
  assert.match(await rows("Tests").first().textContent(), /\u2717 failed/);
  assert.ok((await section.textContent()).includes(point.assertions[0]));
  await section.getByRole("button", { name: "All testpoints" }).click();
  same(await listed(), bins);
  // The file with an open line is shown by itself; its lines, marks and counts are the JSON's.
  const file = closure.files.find((each) => each.count.reached + each.count.excused < each.count.all);
  const lines = await section.locator("table.source tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  assert.deepEqual(lines.map((line) => line[3]), file.source);
  const mark = (number) => {
    const here = file.points.filter((each) => each.line === number || each.lines.includes(number));
    return here.some((each) => !each.hits && !each.excused) ? "\u2717" : here.some((each) => !each.hits) ? "\u2013" : here.length ? "\u2713" : "";
  };
  assert.deepEqual(lines.map((line) => line[1]), file.source.map((_, i) => mark(i + 1)));
  assert.equal(new Set(lines.map((line) => line[1])).size, 4, "reached, excused, open and none of them");
  const compared = await compare_figures(page, "section[data-panel=closure]");
  figure("bins, findings and lines of a closure compared", bins.length + findings.length + lines.length, ">= 18");
  assert.ok(bins.length + findings.length + lines.length >= 18 && compared >= 50);
  await page.finish();
});

test("a closed closure passes, without lines too, and of thousands of bins those in sight are in the page", async () => {
  const many = Object.fromEntries(Array.from({ length: 3000 }, (_, i) => [`group.bin_${i}`, i + 1]));
  const point = { ...closure.testpoints[0], status: "closed", bins: { hit: 3000, all: 3000 }, configurations: [{ config: "tiny", hit: 3000, all: 3000, hits: many }], tests: [] };
  const none = { reached: 0, excused: 0, all: 0 };
  save("closed.json", { ...closure, verdict: "closed", bins: { hit: 3000, all: 3000 }, lines: none, tests: { passed: 0, failed: 0, not_run: 0 }, open: { campaigns: [], testpoints: [], lines: [] }, testpoints: [point], files: [] });
  const page = await open(report("closed", ["closed.json"]));
  assert.match(await page.textContent("#top .mark"), /Pass/);
  const section = page.locator("section[data-panel=closure]");
  assert.match(await section.locator(".lead").textContent(), /Closed: 3\u202f000 of 3\u202f000 bins are hit\./);
  assert.equal(await section.locator("table.source, table[aria-label='What is open'], table[aria-label='Tests']").count(), 0);
  assert.ok((await section.locator("table[aria-label=Bins] tbody tr").count()) < 120);
  await section.getByLabel("Filter Bins: words").fill("hits<4");
  assert.equal(await section.locator("table[aria-label=Bins] tbody tr").count(), 3);
  await compare_figures(page);
  await page.finish();
});

test("2,000 rows: sorting, filtering, the first and the last row", async () => {
  const page = await open(report("long", ["long.json"]));
  const rows = sample_plan(2000).rows;
  const section = page.locator("section[data-panel=plan]");
  const scroll = section.locator(".scroll").first();
  const column = (name) => section.locator("thead th", { hasText: name }).first();
  const numbers = async (name) => {
    const place_of = await column(name).evaluate((head) => [...head.parentElement.children].indexOf(head) + 1);
    return (await section.locator(`tbody tr[aria-rowindex] td:nth-child(${place_of})`).allTextContents()).map((text) => shown_number(text)?.value ?? null);
  };
  assert.ok((await section.locator("tbody tr").count()) < 120, "only rows in sight are in the page");
  await compare_figures(page);
  await column("Cost").locator("button").click();
  assert.equal(await column("Cost").getAttribute("aria-sort"), "ascending");
  const costs = rows.map((row) => row.metrics.cost ?? null).sort((a, b) => (a === null) - (b === null) || a - b);
  const top = await numbers("Cost");
  assert.deepEqual(top, costs.slice(0, top.length));
  await scroll.evaluate((element) => (element.scrollTop = element.scrollHeight));
  await page.waitForFunction((count) => document.querySelector(`tr[aria-rowindex="${count + 1}"]`), rows.length);
  const bottom = await numbers("Cost");
  assert.deepEqual(bottom, costs.slice(-bottom.length));
  await compare_figures(page);
  await column("Cost").locator("button").click();
  const down = await numbers("Cost");
  const falling = [...costs.filter((cost) => cost !== null)].reverse();
  assert.deepEqual(down, falling.slice(0, down.length));
  const limit = falling[900];
  const begun = Date.now();
  await section.locator("input[type=search]").first().fill(`Cost<${limit} index.kind=linear`);
  const took = Date.now() - begun;
  const wanted = rows.filter((row) => row.metrics.cost < limit && row.axes["index.kind"] === "linear").length;
  const shown = await section.locator(".controls .note").first().textContent();
  assert.equal(shown_number(shown).value, wanted);
  assert.ok(wanted > 50 && wanted < 1000);
  figure("rows left by the filter", wanted);
  figure("milliseconds of filtering 2,000 rows", took, "< 1500");
  assert.ok(took < 1500);
  await page.finish();
});

test("the Pareto front is that of brute force, and a brush lists what lies in it", async () => {
  const page = await open(report("plan", ["plan.json"]), { height: 1200 });
  const plan = sample_plan(240);
  const section = page.locator("section[data-panel=plan]");
  const [x, y] = await section.locator(".controls select").evaluateAll((all) => all.slice(0, 2).map((select) => select.value));
  const front = (await section.locator("[data-front]").getAttribute("data-front")).split(" ");
  const wanted = brute_front(plan, x, y);
  assert.deepEqual([...front].sort(), wanted.sort());
  figure(`rows on the front of ${y} over ${x}`, front.length, ">= 3");
  assert.ok(front.length >= 3);
  const over = section.locator(".u-over");
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + box.width * 0.3, box.y + box.height * 0.2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height * 0.5, { steps: 4 });
  await page.mouse.move(box.x + box.width * 0.65, box.y + box.height * 0.8, { steps: 4 });
  await page.mouse.up();
  const rows_listed = async () => (await section.locator("tbody").first().locator("tr[aria-rowindex] code").allTextContents()).map((text) => text.trim());
  const listed = await rows_listed();
  const by_id = new Map(plan.rows.map((row) => [row.id.slice(0, 12), row]));
  const inside = listed.map((id) => by_id.get(id));
  assert.ok(inside.length > 5 && inside.length < 120, `${inside.length} rows in the rectangle`);
  const range = (name) => [Math.min(...inside.map((row) => row.metrics[name])), Math.max(...inside.map((row) => row.metrics[name]))];
  const [[x0, x1], [y0, y1]] = [range(x), range(y)];
  for (const row of plan.rows) {
    const within = row.metrics[x] >= x0 && row.metrics[x] <= x1 && row.metrics[y] >= y0 && row.metrics[y] <= y1;
    assert.ok(!within || inside.includes(row), `${row.id} lies among the listed rows and is not listed`);
  }
  figure("rows in the rectangle", inside.length);
  await section.getByRole("button", { name: "All rows" }).click();
  assert.equal(shown_number(await section.locator(".controls .note").first().textContent()).value, plan.rows.length);
  await page.finish();
});

test("the front of a real plan is that of plan pareto", async () => {
  const page = await open(report("merged-page", ["merged.json"]));
  const section = page.locator("section[data-panel=plan]");
  const { results } = await data_of(page);
  assert.equal(results[0].rows.length, 6);
  const [x, y] = await section.locator(".controls select").evaluateAll((all) => all.slice(0, 2).map((select) => select.value));
  assert.equal(`${x} ${y}`, "cost psnr_db");
  const shown = result("front", ["plan", "pareto", "merged.json", "--x", x, "--y", y]);
  const wanted = shown.front.map((row) => row.id ?? row);
  const front = (await section.locator("[data-front]").getAttribute("data-front")).split(" ");
  assert.deepEqual([...front].sort(), [...wanted].sort());
  const compared = await compare_figures(page, "section[data-panel=plan]");
  figure("cases of a real plan on the front, as plan pareto has it", front.length, ">= 2");
  assert.ok(front.length >= 2 && compared >= 6 * 5);
  await page.finish();
});

test("rows are chosen with the keyboard and shown in the plot", async () => {
  const page = await open(report("plan", ["plan.json"]), { height: 1200 });
  const section = page.locator("section[data-panel=plan]");
  const canvas = () => section.locator("canvas").evaluate((element) => element.toDataURL());
  const before_choice = await canvas();
  await section.locator("tbody tr[tabindex='0']").first().focus();
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  const chosen = section.locator("tr[aria-selected=true]");
  assert.equal(await chosen.count(), 1);
  assert.equal(await chosen.getAttribute("aria-rowindex"), "4");
  assert.notEqual(await canvas(), before_choice);
  await page.finish();
});

test("a drawing is one stop of Tab, and arrows tell every bar's number", async () => {
  const page = await open(report("plain", ["cycles.json"]));
  const { results } = await data_of(page);
  const svg = page.locator("section[data-panel=cycles] svg").first();
  assert.equal(await svg.locator("[tabindex='0']").count(), 1);
  await svg.locator("[tabindex='0']").focus();
  const shown = [];
  const count = Object.keys(results[0].cycles.account).length + 1;
  for (let i = 0; i < count; ++i) {
    shown.push(await page.locator("section[data-panel=cycles] .tip").first().textContent());
    await page.keyboard.press("ArrowDown");
  }
  for (const [i, cycles] of [...Object.values(results[0].cycles.account), results[0].cycles.actual].entries()) assert.equal(shown_number(shown[i].split(": ")[1]).value, cycles, shown[i]);
  figure("bars read with the keyboard", shown.length, ">= 9");
  await page.finish();
});

test("the timeline shows the tile that is asked for", async () => {
  const page = await open(all);
  const { results } = await data_of(page);
  const index = results.findIndex((each) => each.timeline);
  const section = page.locator(`#cycles-${index}`);
  const tiles = results[index].timeline.tiles.length;
  assert.ok(tiles > 1, "the scene has several tiles");
  await section.locator("select").selectOption("1");
  const sheets = results[index].timeline.sheets.filter((row) => row[0] === 1);
  assert.equal(shown_number(await section.locator(".controls .note").textContent()).value, sheets.length);
  const compared = await compare_figures(page, `#cycles-${index}`);
  figure("sheets of tile 1", sheets.length, "> 0");
  assert.ok(sheets.length > 0 && compared > sheets.length);
  await page.finish();
});

test("no panel is wider than the page, and no two parts of one overlap", async () => {
  let parts = 0;
  for (const theme of ["light", "dark"]) {
    for (const width of [390, 1000, 1280, 1800]) {
      const page = await open(all, { width, theme });
      const found = await page.evaluate(() => {
        const wrong = [];
        let count = 0;
        if (document.documentElement.scrollWidth > innerWidth) wrong.push(`the page is ${document.documentElement.scrollWidth} wide`, ...[...document.querySelectorAll("main *")].filter((each) => each.getBoundingClientRect().right > innerWidth + 1 && !each.closest(".scroll, pre")).map((each) => `${each.tagName} "${each.textContent.slice(0, 40)}" ends at ${each.getBoundingClientRect().right}`).slice(0, 3));
        const boxes = [...document.querySelectorAll("section.panel p, section.panel figure, section.panel .table, section.panel dl, section.panel .controls, section.panel ul, section.panel h3, section.panel figcaption, section.panel svg, section.panel .uplot")]
          .filter((each) => !each.closest("details, figure figure, .table .controls, [data-panel=pictures]") && (each.matches("svg, .uplot, figcaption") || !each.parentElement.closest("figure")))
          .map((each) => ({ each, box: each.getBoundingClientRect() }))
          .filter(({ box }) => box.width > 0 && box.height > 0);
        for (const { each, box } of boxes) {
          ++count;
          if (box.right > innerWidth + 1 || box.left < -1) wrong.push(`${each.className || each.tagName} ends at ${box.right}`);
          for (const other of boxes) {
            if (other.each === each || other.each.contains(each) || each.contains(other.each)) continue;
            const o = other.box;
            if (Math.min(box.right, o.right) - Math.max(box.left, o.left) > 1 && Math.min(box.bottom, o.bottom) - Math.max(box.top, o.top) > 1)
              wrong.push(`${each.textContent.slice(0, 40)} overlaps ${other.each.textContent.slice(0, 40)}`);
          }
        }
        // Text of a drawing lies in the drawing.
        for (const label of document.querySelectorAll("section.panel:not([data-panel=pictures]) svg text")) {
          const box = label.getBoundingClientRect();
          const host = label.ownerSVGElement.getBoundingClientRect();
          if (box.width && (box.left < host.left - 14 || box.right > host.right + 14)) wrong.push(`"${label.textContent}" is cut: ${box.left} to ${box.right} in ${host.left} to ${host.right}`);
        }
        return { wrong, count };
      });
      assert.deepEqual(found.wrong, [], `${theme}, ${width} px`);
      parts += found.count;
      await page.finish();
    }
  }
  figure("parts of panels without overlap", parts, ">= 300");
  assert.ok(parts >= 300);
});

test("a name without blanks is broken, not the page", async () => {
  const long = `${"a_name_that_goes_on_and_on_".repeat(6)}.nii.gz`;
  const [golden, cycles, errors] = ["golden", "cycles", "errors"].map((name) => JSON.parse(readFileSync(place(`${name}.json`), "utf8")));
  save("long-golden.json", { ...golden, scene: { ...golden.scene, volume: long, toml: golden.scene.toml.replace("shells:24", long) } });
  save("long-cycles.json", { ...cycles, scene: cycles.scene.replace("shells:24", long) });
  save("long-errors.json", { ...errors, scene: errors.scene.replace("shells:24", long), remedy: { ...errors.remedy, changes: long } });
  for (const width of [320, 390, 1280]) {
    const page = await open(report("long-names", ["long-golden.json", "long-cycles.json", "long-errors.json"]), { width });
    assert.ok((await page.textContent("h1")).includes(long));
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    figure(`width of a page with long names at ${width}`, wide, width);
    assert.ok(wide <= width);
    await page.finish();
  }
});

test("text is drawn with a font, dark is dark, and the button turns it round", async () => {
  const page = await open(all, { theme: "dark" });
  const session = await page.context().newCDPSession(page);
  await session.send("DOM.enable");
  await session.send("CSS.enable");
  const { root } = await session.send("DOM.getDocument");
  const { nodeId } = await session.send("DOM.querySelector", { nodeId: root.nodeId, selector: ".lead" });
  const { fonts } = await session.send("CSS.getPlatformFontsForNode", { nodeId });
  assert.ok(fonts.length > 0 && fonts[0].glyphCount > 10, "letters without a font are invisible");
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const canvas = () => page.locator(".plot canvas").first().evaluate((element) => element.toDataURL());
  const [dark, plot] = [await paper(), await canvas()];
  await page.getByRole("button", { name: "Light colours" }).click();
  assert.notEqual(await paper(), dark);
  assert.notEqual(await canvas(), plot, "plots are drawn again in the other colours");
  // CSS.enable makes the browser itself fetch the page's source, and a busy one reports that.
  await page.finish([/Unsafe attempt to load URL file:/]);
});

test("printed, tables are whole and controls are gone", async () => {
  const page = await open(report("long", ["long.json"]));
  await page.emulateMedia({ media: "print" });
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.equal(await page.locator("section[data-panel=plan] tbody tr[aria-rowindex]").count(), 2000);
  assert.equal(await page.locator("#contents").isVisible(), false);
  assert.equal(await page.locator(".controls").first().isVisible(), false);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
  await page.finish();
});

test("empty results and foreign text do no harm", async () => {
  const evil = '</script><img src=x onerror="window.hurt=1"><!-- <script>';
  const plan = sample_plan(3);
  plan.name = evil;
  plan.rows[0].message = evil;
  plan.rows[0].command = evil;
  save("evil.json", plan);
  const page = await open(report("evil", ["evil.json"]));
  assert.equal(await page.evaluate(() => window.hurt), undefined);
  assert.equal(await page.locator("img").count(), 0);
  assert.ok((await page.locator("section h2").first().textContent()).includes(evil));
  await page.finish();
  save("none.json", { ...sample_plan(0), metrics: [] });
  const family = JSON.parse(readFileSync(place("family.json"), "utf8"));
  save("no-cells.json", { ...family, cells: [] });
  const empty = await open(report("empty", ["none.json", "no-cells.json"]));
  assert.match(await empty.textContent("section[data-panel=plan]"), /no case/);
  assert.match(await empty.textContent("section[data-panel=family]"), /no cell/);
  await empty.finish();
});

test("a result that breaks a panel fails the page by name, and the other panels stand", async () => {
  const page_text = readFileSync(report("good", ["compare.json", "cycles.json"]), "utf8");
  const broken = page_text.replace('"account":', '"account_is_gone":');
  assert.notEqual(broken, page_text);
  save("broken.html", broken);
  const page = await open(place("broken.html"), { ready: "error" });
  assert.match(await page.textContent(".broken"), /Cycles could not be drawn/);
  assert.equal(await page.locator("section[data-panel=compare] svg").count() > 0, true);
  await page.finish([/Cycles/]);
});
