#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tests of the page, for ctest. usage: run.sh template|browser PROGRAM FOLDER
# Exit code 77, with the reason, where node, chromium or the registry is not to be had. Packages go into FOLDER.
set -euo pipefail

what=$1 program=$2 folder=$3
web="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)"

source "$web/../../tools/helpers/npm.sh"

need_node
if [[ $what == browser ]]; then
  need_chromium
  command -v oiiotool >/dev/null || skip "no oiiotool (Debian: openimageio-tools)"
fi

folder=$folder/web
mkdir -p -- "$folder"
exec 9>"$folder/.lock"
flock 9
npm_into "$folder" "$web"
# As the tree has it: report/template.html lies beside report/web.
rm -rf -- "$folder/src" "$folder/LICENSES" "$folder/test"
cp -r -- "$web/src" "$web/LICENSES" "$web/test" "$web/build.mjs" "$web/tsconfig.json" "$folder"
cp -- "$web/../template.html" "$folder/../template.html"
flock -u 9

cd -- "$folder"
case $what in
  template)
    node node_modules/typescript/bin/tsc --noEmit
    node build.mjs "$folder/template.html"
    if ! cmp -- "$folder/template.html" "$web/../template.html"; then
      echo "report/template.html is not what report/web builds: cd report/web && npm ci && node build.mjs" >&2
      exit 1
    fi
    echo "[figure] bytes rebuilt and equal = $(wc -c <"$folder/template.html") (limit > 0)"
    ;;
  browser)
    export FASTSPLAT="$program" CHROMIUM
    status=0
    for test in test/*.test.mjs; do node "$test" || status=1; done
    exit "$status"
    ;;
  *) exit 2 ;;
esac
