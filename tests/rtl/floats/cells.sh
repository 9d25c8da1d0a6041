#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# cells.sh SOURCE_DIR WORK_DIR: cells of the float operators for Xilinx 7 by Yosys, as rows of the table in docs/floats.md.
# Exit code 1: the page has other rows.
set -eu
source=$1 work=$2
command -v yosys >/dev/null || { echo "skipped: no yosys (Debian: yosys)"; exit 77; }
here="$source/tests/rtl/floats"
mkdir -p "$work"
wrong=0
for format in "fp16 5 10" "bf16 8 7" "tf19 8 10"; do
  set -- $format
  for top in float_mul float_add float_lane float_composite; do
    yosys -q -p "read_verilog -sv $here/float_mul.sv $here/float_add.sv $here/float_lane.sv $here/float_composite.sv
      chparam -set E $2 -set F $3 $top; synth_xilinx -family xc7 -flatten -noiopad -noclkbuf -top $top; tee -o $work/$1-$top.stat stat" >/dev/null
    row=$(awk -v row="| $1 | $top |" '/ LUT[1-6] /{lut += $2} / CARRY4 /{carry = $2} / DSP48E1 /{dsp = $2} END{print row, lut + 0, "|", carry + 0, "|", dsp + 0, "|"}' "$work/$1-$top.stat")
    echo "$row"
    grep -qF "$row" "$source/docs/floats.md" || { echo "docs/floats.md has no such row"; wrong=1; }
  done
done
exit "$wrong"
