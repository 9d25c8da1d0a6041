#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tests of the lab's page, for ctest. usage: run.sh page|browser LAB_JS LAB_WASM FOLDER
# page: type check and build, FOLDER/lab.html. browser: the page in headless Chromium.
# Exit code 77, with the reason, where node, npm, chromium or the registry is not to be had. Packages go into FOLDER.
set -euo pipefail

what=$1 js=$(realpath -- "$2") wasm=$(realpath -- "$3") folder=$4
web="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)"
report="$(cd -- "$web/../../report/web" && pwd -P)"

source "$web/../../tools/helpers/npm.sh"

need_node
chromium=
if [[ $what == browser ]]; then
  for name in chromium chromium-headless-shell google-chrome; do
    chromium=$(command -v "$name") && break
  done
  [[ -n $chromium ]] || skip "no chromium (Debian: chromium)"
fi

mkdir -p -- "$folder"
folder=$(cd -- "$folder" && pwd -P)
exec 9>"$folder/.lock"
flock 9
npm_into "$folder" "$report"
# As the tree has it: lab/web beside report/web, and the packages above both.
rm -rf -- "$folder/lab" "$folder/report"
mkdir -p -- "$folder/lab/web" "$folder/report/web"
cp -r -- "$web/src" "$web/test" "$web/index.html" "$web/lab.css" "$web/build.mjs" "$web/tsconfig.json" "$folder/lab/web"
cp -r -- "$report/src" "$report/LICENSES" "$folder/report/web"
flock -u 9

cd -- "$folder/lab/web"
case $what in
  page)
    "$folder/node_modules/.bin/tsc" --noEmit -p .
    node build.mjs "$js" "$wasm" "$folder/lab.html"
    echo "[figure] bytes of the page = $(wc -c <"$folder/lab.html") (limit 3000000)"
    ;;
  browser)
    node build.mjs "$js" "$wasm" "$folder/lab.html"
    export LAB="$folder/lab.html" CHROMIUM="$chromium"
    status=0
    for test in test/*.test.mjs; do node "$test" || status=1; done
    exit "$status"
    ;;
  *) exit 2 ;;
esac
