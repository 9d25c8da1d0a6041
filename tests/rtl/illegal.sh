#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# illegal.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR: a package with illegal numbers stops Verilator and Yosys with a message
# that names them.
set -eu
emit=$1 source=$2 work=$3
mkdir -p "$work"
checked=0

# refused NAME=VALUE TEXT [CONFIGURATION]: its package (tiny's) with one number changed.
refused() {
  name=${1%=*} value=${1#*=} text=$2
  "$emit" "$source/configs/${3:-tiny}.toml" | sed "s/localparam int $name = .*;/localparam int $name = $value;/" >"$work/fastsplat_pkg.sv"
  grep -q "localparam int $name = $value;" "$work/fastsplat_pkg.sv" || { echo "the package has no $name"; exit 1; }
  if verilator --lint-only --top-module fastsplat_core "-I$source/rtl" "$work/fastsplat_pkg.sv" "$source"/rtl/*.sv "$source"/rtl/*/*.sv >"$work/lint.log" 2>&1; then
    echo "$1: Verilator accepts it"; exit 1
  fi
  grep -q "$text" "$work/lint.log" || { cat "$work/lint.log"; echo "$1: Verilator does not say: $text"; exit 1; }
  if yosys -l "$work/yosys.log" -p "read_verilog -sv -I$source/rtl $work/fastsplat_pkg.sv $source/rtl/*.sv $source/rtl/*/*.sv; hierarchy -check -top fastsplat_core" >/dev/null 2>&1; then
    echo "$1: Yosys accepts it"; exit 1
  fi
  grep -q "$text" "$work/yosys.log" || { tail -5 "$work/yosys.log"; echo "$1: Yosys does not say: $text"; exit 1; }
  grep -q 'illegal_parameter_' "$work/yosys.log" || { tail -5 "$work/yosys.log"; echo "$1: Yosys stops for another reason"; exit 1; }
  echo "[figure] $1 refused by both: $text"
  checked=$((checked + 1))
}

refused BANKS=5 "BANKS is 5, but LANES squared is 4"
refused POS_FRAC=2 "POS_FRAC is 2, but phases need 3 fraction bits"
refused RADIAL_ENTRIES=63 "RADIAL_ENTRIES is 63, but 2^RADIAL_LOG2 is 64"
refused BLOCKS_Y=17 "BLOCKS is 256, but BLOCKS_X \* BLOCKS_Y is 272"
refused RLUT_COLUMNS=15 "RLUT_COLUMNS is 15, but must be a multiple of 2"
refused SLICES=2 "SLICES is 2, but 1 of COMPOSITE_LANES pixels make a block"
# M-density-2
refused CULL_MAP=2 "CULL_MAP is 2, but DENSITIES is 1, not 0" faults/post
refused DENSITIES=1 "CULL_MAP is 1, but DENSITIES is 1, not 0" faults/cull
refused DENSITIES=1 "EVERY_SAMPLE is 1, but DENSITIES is 1, not 0" faults/westover
[ "$checked" -eq 9 ]
