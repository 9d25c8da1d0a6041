// SPDX-License-Identifier: Apache-2.0
// usage: node read.mjs FOLDER SOURCE_DIR PACKAGE...: the newest Yosys (@yowasp/yosys, npm, installed in FOLDER) reads
// every file of rtl/ by itself and elaborates fastsplat_top and fastsplat_fetch with the package of each configuration.
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, relative } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, source, ...packages] = process.argv.slice(2);
const { runYosys, version } = await import(pathToFileURL(createRequire(join(folder, 'x.js')).resolve('@yowasp/yosys')).href);

const rtl = join(source, 'rtl');
const names = readdirSync(rtl, { recursive: true }).filter((name) => /\.svh?$/.test(name)).sort();
const tree = {};
for (const name of names) {
  const parts = name.split('/');
  const last = parts.pop();
  let at = tree;
  for (const part of parts) at = at[part] ??= {};
  at[last] = readFileSync(join(rtl, name), 'utf8');
}
const units = names.filter((name) => name.endsWith('.sv'));

let read = 0;
for (const path of packages) {
  for (const top of ['fastsplat_top', 'fastsplat_fetch']) {
    const script = ['read_verilog -sv pkg.sv']
      .concat(units.flatMap((name) => ['verilog_defines -reset', `read_verilog -sv -Irtl rtl/${name}`]))
      .concat(`hierarchy -check -top ${top}`, 'proc', 'check -assert', 'stat');
    let log = '';
    const take = (bytes) => { if (bytes !== null) log += new TextDecoder().decode(bytes); };
    try {
      await runYosys(['-s', 'run.ys'], { 'run.ys': script.join('\n') + '\n', 'pkg.sv': readFileSync(path, 'utf8'), rtl: tree },
                     { stdout: take, stderr: take });
    } catch (error) {
      console.log(log.split('\n').slice(-8).join('\n'));
      console.log(`read.mjs: ${relative('.', path)}: Yosys ${version} refuses ${top}: ${error.message}`);
      process.exit(1);
    }
    const found = log.match(/.*(implicit|used before).*/i);
    if (found !== null || !/cells/.test(log)) {
      console.log(`read.mjs: ${relative('.', path)}, ${top}: ${found === null ? 'nothing was read' : found[0]}`);
      process.exit(1);
    }
    ++read;
  }
}
console.log(`[figure] Yosys ${version}: files = ${units.length}, designs read = ${read} (expected ${2 * packages.length})`);
process.exit(read > 0 && read === 2 * packages.length ? 0 : 1);
