// SPDX-License-Identifier: Apache-2.0
// Fetches packages from npm's registry without npm, which is 400 packages of Debian's: those named and what they need, as
// package-lock.json has them, checked by its hashes. usage: node npm_files.mjs PACKAGE-LOCK.json FOLDER [NAME...]; all without names
// Exit code 77, with the reason, where the registry is not to be had.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [lock, folder, ...names] = process.argv.slice(2);
const { packages } = JSON.parse(readFileSync(lock, "utf8"));
const registry = (process.env.npm_config_registry ?? "https://registry.npmjs.org").replace(/\/$/, "");
const fits = (list, value) => !list || list.includes(value);

async function fetched(url) {
  try {
    const response = await fetch(url);
    if (response.ok) return Buffer.from(await response.arrayBuffer());
    throw new Error(`status ${response.status}`);
  } catch (error) {
    console.log(`skipped: ${url} is not to be had (${error.cause?.code ?? error.message})`);
    process.exit(77);
  }
}

async function install(name) {
  const one = packages[`node_modules/${name}`];
  if (!one || !fits(one.os, process.platform) || !fits(one.cpu, process.arch)) return;
  const to = join(folder, "node_modules", name), stamp = join(to, ".integrity");
  if (!existsSync(stamp) || readFileSync(stamp, "utf8") !== one.integrity) {
    const url = `${registry}/${name}/-/${name.replace(/.*\//, "")}-${one.version}.tgz`;
    const bytes = await fetched(url);
    const [algorithm, hash] = one.integrity.split(/-(.*)/s);
    if (createHash(algorithm).update(bytes).digest("base64") !== hash) throw new Error(`${url}: its hash is not the one of ${lock}`);
    mkdirSync(to, { recursive: true });
    execFileSync("tar", ["-xzf", "-", "--strip-components=1", "-C", to], { input: bytes });
    writeFileSync(stamp, one.integrity);
  }
  for (const more of Object.keys({ ...one.dependencies, ...one.optionalDependencies })) await install(more);
}

const { dependencies, devDependencies } = packages[""];
for (const name of names.length ? names : Object.keys({ ...dependencies, ...devDependencies })) {
  if (!packages[`node_modules/${name}`]) throw new Error(`${lock} has no package ${name}`);
  await install(name);
}
