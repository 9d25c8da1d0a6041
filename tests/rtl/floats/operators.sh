#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# operators.sh EXPONENT FRACTION SOURCE_DIR WORK_DIR: simulates float_add and float_mul with every pair of operands.
set -eu
source=$3 work=$4
here="$source/tests/rtl/floats"
rm -rf "$work"
mkdir -p "$(dirname "$work")"
verilator --cc --exe --build -Wall -O3 -CFLAGS "-O2 -std=c++20 -I$source" -GE="$1" -GF="$2" --top-module operators --Mdir "$work" \
  "$here"/float_add.sv "$here"/float_mul.sv "$here"/operators.sv "$here"/compare.cpp >"$work.log" 2>&1 || { cat "$work.log"; exit 1; }
"$work/Voperators" "$1" "$2"
