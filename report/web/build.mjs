// SPDX-License-Identifier: Apache-2.0
// Builds ../template.html, the page that C++ fills: one file, no address in it, the same bytes everywhere.
// usage: node build.mjs [OUT.html]
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const placeholder = "<!--FASTSPLAT-DATA-->";
const limit = 180_000; // bytes: every report carries the template

const bundled = await build({
  absWorkingDir: here,
  entryPoints: ["src/main.ts"],
  bundle: true,
  write: false,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  outdir: "out",
  loader: { ".css": "css" },
});
const text = (ending) => bundled.outputFiles.find((file) => file.path.endsWith(ending)).text;
const script = text(".js").trim().replaceAll("</script", "<\\/script");
const style = text(".css").trim();
if (style.includes("</style")) throw new Error("the style sheet ends itself");
const notice = readFileSync(join(here, "LICENSES/uPlot.txt"), "utf8").trim();

const parts = {
  "@STYLE@": style,
  "@SCRIPT@": script,
  "@SCRIPT-HASH@": createHash("sha256").update(script, "utf8").digest("base64"),
  "@NOTICE@": notice,
};
// A function: in a text, `$&` of the bundle would be taken for what was found.
const page = readFileSync(join(here, "src/index.html"), "utf8").replace(/@[A-Z-]+@/g, (name) => parts[name] ?? name);

const count = page.split(placeholder).length - 1;
if (count !== 1) throw new Error(`${placeholder}: expected once, got ${count} times`);
if (/[^\x09\x0a\x20-\x7e]/.test(page)) throw new Error("the page is not plain ASCII");
if (!page.includes("Leon Sorokin")) throw new Error("uPlot's notice is missing");
if (page.length > limit) throw new Error(`the page: at most ${limit} bytes, got ${page.length}`);
writeFileSync(process.argv[2] ?? join(here, "../template.html"), page);
console.log(`template.html: ${page.length} bytes, script ${script.length}, style ${style.length}`);
