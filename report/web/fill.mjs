// SPDX-License-Identifier: Apache-2.0
// A report for development without the program: results into the template.
// usage: node fill.mjs TEMPLATE OUT.html RESULT.json...
import { readFileSync, writeFileSync } from "node:fs";

const [template, out, ...files] = process.argv.slice(2);
const results = files.map((file) => JSON.parse(readFileSync(file, "utf8")));
const data = {
  program: "fastsplat, development sample",
  made: results.map((result) => result.command ?? "").filter(Boolean),
  verdict: { status: "pass", sentence: "Every comparison is within its limits." },
  results,
  pictures: [],
};
const text = JSON.stringify(data).replace(/[<>&\u2028\u2029]/g, (c) => "\\u" + c.charCodeAt(0).toString(16).padStart(4, "0"));
const page = readFileSync(template, "utf8");
writeFileSync(out, page.replace("<!--FASTSPLAT-DATA-->", () => `<script type="application/json" id="data">${text}</script>`));
