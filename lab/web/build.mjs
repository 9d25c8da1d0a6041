// SPDX-License-Identifier: Apache-2.0
// Builds the lab: one HTML file with the page, the worker and the engine in it.
// usage: node build.mjs LAB_JS LAB_WASM OUT.html
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const limit = 3_000_000; // bytes
const [lab_js, lab_wasm, out] = process.argv.slice(2);
if (!out) {
  console.error("usage: node build.mjs LAB_JS LAB_WASM OUT.html");
  process.exit(2);
}

async function bundled(entry) {
  const { outputFiles } = await build({
    absWorkingDir: here,
    entryPoints: [entry],
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
  return (ending) => outputFiles.find((file) => file.path.endsWith(ending))?.text.trim() ?? "";
}
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString("base64");

const page = await bundled("src/main.ts");
const worker = (await bundled("src/worker.ts"))(".js");
const script = page(".js").replaceAll("</script", "<\\/script");
const style = page(".css");
if (style.includes("</style")) throw new Error("the style sheet ends itself");

const parts = {
  "@STYLE@": style,
  "@SCRIPT@": script,
  "@SCRIPT-HASH@": createHash("sha256").update(script, "utf8").digest("base64"),
  "@ENGINE-SCRIPT@": packed(`${readFileSync(lab_js, "utf8")}\n${worker}\n`),
  "@ENGINE-WASM@": packed(readFileSync(lab_wasm)),
  "@NOTICE@": readFileSync(join(here, "LICENSES.txt"), "utf8").trim().replaceAll("&", "&amp;").replaceAll("<", "&lt;"),
};
// A function: in a text, `$&` of the bundle would be taken for what was found.
const html = readFileSync(join(here, "index.html"), "utf8").replace(/@[A-Z-]+@/g, (name) => parts[name] ?? name);

if (/[^\x09\x0a\x20-\x7e]/.test(html)) throw new Error("the page is not plain ASCII");
if (html.length > limit) throw new Error(`the page: at most ${limit} bytes, got ${html.length}`);
writeFileSync(out, html);
console.log(`${out}: ${html.length} bytes, script ${script.length}, style ${style.length}, engine ${parts["@ENGINE-WASM@"].length}`);
