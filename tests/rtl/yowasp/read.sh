#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: read.sh EMIT_PACKAGE SOURCE_DIR FOLDER: read.mjs for configurations that together have every feature. npm's
# packages go into FOLDER.
set -euo pipefail
emit=$1 source=$2 folder=$3
source "$source/tools/helpers/npm.sh"
need_node
mkdir -p -- "$folder"
npm_into "$folder" "$source/tests/rtl/yowasp"
packages=()
for config in tiny ellipse faults/cull faults/post; do
  packages+=("$folder/${config##*/}.sv")
  "$emit" "$source/configs/$config.toml" >"${packages[-1]}"
done
exec node "$source/tests/rtl/yowasp/read.mjs" "$folder" "$source" "${packages[@]}"
