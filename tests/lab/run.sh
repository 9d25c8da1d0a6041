#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests of the lab for ctest; builds its engine as ./run lab does. usage: run.sh equal|page ROOT NATIVE
#   equal: the engine as WebAssembly beside NATIVE, the same engine natively; page: lab.html in a browser
# Exit code 77, with the reason, where a tool or the network is not to be had.
what=$1 native=$3
source "$2/run"
source "$root/tools/helpers/npm.sh"

need_node
command -v emcc >/dev/null || skip "no emcc (Debian: emscripten)"
build=$root/build-lab needs+=(lab) chosen_preset=lab
"$root/tools/helpers/lab_sources" "$build/sources" || skip "the sources of the lab's C libraries are not to be had"
build_targets lab
case $what in
  equal) exec node --no-experimental-fetch "$root/tests/lab/equal.cjs" "$build/bin/lab.js" "$native" ;;
  page) exec "$root/tools/helpers/lab_page" "$root" "$build" "$build/lab.html" test ;;
  *) exit 2 ;;
esac
