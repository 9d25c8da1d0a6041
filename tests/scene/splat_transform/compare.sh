#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: compare.sh FASTSPLAT SOURCE_DIR FOLDER: files that splat-transform wrote, as fastsplat and splat-transform read
# them, and files that fastsplat wrote. npm's packages and the files go into FOLDER.
set -euo pipefail
fastsplat=$1 source=$2 folder=$3
source "$source/tools/helpers/npm.sh"
need_node
mkdir -p -- "$folder"
npm_into "$folder" "$source/tests/scene/splat_transform"
# webgpu, 60 MB, draws on a graphics processor: package-lock.json leaves it out, and converting needs only its name.
mkdir -p -- "$folder/node_modules/webgpu"
echo '{"name": "webgpu", "type": "module", "exports": "./index.js"}' >"$folder/node_modules/webgpu/package.json"
echo 'export const globals = {}; export const create = () => undefined;' >"$folder/node_modules/webgpu/index.js"
cd -- "$folder"
transform() {
  node node_modules/@playcanvas/splat-transform/bin/cli.mjs --overwrite --gpu cpu "$@" >transform.log 2>&1 ||
    { cat transform.log; return 1; }
}
convert() { "$fastsplat" gaussians convert "$@" --quiet; }

failed=0
# compare NAME FILE: a file as both programs read it, each written as .ply
compare() {
  convert "$2" ours.ply
  transform "$2" theirs.ply
  node "$source/tests/scene/splat_transform/compare.mjs" "$1" ours.ply theirs.ply "$3" || failed=1
}
for scene in shells:3000 cloud:3000; do
  rm -f -- *.spz *.sog *.glb *.splat *.ply
  convert "$scene" scene.ply
  # Both decode the same codes: they differ by a float's rounding of logarithms.
  transform scene.ply v3.spz --spz-version 3
  transform scene.ply v4.spz
  transform scene.ply theirs.compressed.ply
  transform scene.ply theirs.sog --iterations 1
  compare "$scene, its SPZ 3" v3.spz exact
  compare "$scene, its SPZ 4" v4.spz exact
  compare "$scene, its compressed PLY" theirs.compressed.ply exact
  compare "$scene, its SOG" theirs.sog exact
  convert "$scene" ours.spz
  convert "$scene" ours.compressed.ply
  convert "$scene" ours.splat
  compare "$scene, our SPZ" ours.spz exact
  compare "$scene, our compressed PLY" ours.compressed.ply exact
  compare "$scene, our .splat" ours.splat splat
  # It writes glTF and does not read it: against the scene that it wrote.
  transform scene.ply theirs.glb
  convert theirs.glb ours.ply
  node "$source/tests/scene/splat_transform/compare.mjs" "$scene, its glTF" ours.ply scene.ply turned || failed=1
done
exit "$failed"
