#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# read.sh CONFIG EMIT_PACKAGE SOURCE_DIR WORK_DIR: both tools accept rtl/ with the package of CONFIG. Verilator -Wall
# prints nothing. Yosys reads every module, elaborates the device, and `check -assert` finds nothing.
set -eu
config=$1 emit=$2 source=$3 work=$4
mkdir -p "$work"
"$emit" "$source/configs/$config.toml" >"$work/fastsplat_pkg.sv"

verilator --lint-only -Wall --assert --top-module fastsplat_top "-I$source/rtl" "$work/fastsplat_pkg.sv" "$source"/rtl/*.sv "$source"/rtl/*/*.sv >"$work/lint.log" 2>&1 ||
  { cat "$work/lint.log"; echo "$config: Verilator refuses the RTL"; exit 1; }
# Newer Verilators end with statistics, in lines that begin with "- ".
! grep -v '^- ' "$work/lint.log" >"$work/warnings.log" || { cat "$work/warnings.log"; echo "$config: Verilator warns"; exit 1; }

yosys -q -l "$work/yosys.log" -p "read_verilog -sv -I$source/rtl $work/fastsplat_pkg.sv $source/rtl/*.sv $source/rtl/*/*.sv; hierarchy -check -top fastsplat_top; proc; opt_clean; check -assert; tee -o $work/stat.txt stat" >/dev/null 2>&1 ||
  { tail -20 "$work/yosys.log"; echo "$config: Yosys refuses the RTL"; exit 1; }

# M-reset-1: the reset is synchronous. Yosys makes these cells for registers that a reset changes between clock edges.
! grep -q '\$\(adff\|aldff\|dffsr\)' "$work/stat.txt" || { echo "$config: the device has asynchronously reset registers"; exit 1; }

# Every module of rtl/ must be in the elaborated design, as itself or with parameters.
modules=0
ellipses=$(sed -n 's/.* ELLIPSES = \([01]\);/\1/p' "$work/fastsplat_pkg.sv")
culls=$(sed -n 's/.* CULL_MAP = \([012]\);/\1/p' "$work/fastsplat_pkg.sv")
samples=$(sed -n 's/.* EVERY_SAMPLE = \([01]\);/\1/p' "$work/fastsplat_pkg.sv")
densities=$(sed -n 's/.* DENSITIES = \([01]\);/\1/p' "$work/fastsplat_pkg.sv")
for module in $(sed -n 's/^module \([a-z0-9_]*\).*/\1/p' "$source"/rtl/*.sv "$source"/rtl/*/*.sv); do
  case $ellipses$module in 0fastsplat_ellipse*) continue ;; esac  # the configuration has none
  case $samples$module in 0fastsplat_overlap | 0fastsplat_sample_places) continue ;; esac
  case $densities$module in 0fastsplat_densit* | 0fastsplat_classify*) continue ;; esac
  case $module in fastsplat_fetch | fastsplat_queue) continue ;; esac  # read_fetch.sh
  case $culls$module in 0fastsplat_cull* | 1fastsplat_cull_pixels) continue ;; esac
  grep -q "^=== \(\$paramod.*\\\\\)\?$module\(\\\\.*\)\? ===" "$work/stat.txt" || { echo "$config: module $module is not in the design"; exit 1; }
  modules=$((modules + 1))
done
[ "$modules" -gt 0 ] || { echo "$config: no module was read"; exit 1; }
elaborated=$(grep -c '^=== ' "$work/stat.txt")
cells=$(sed -n '/^=== design hierarchy/,$s/^ *Number of cells: *\([0-9]*\)$/\1/p' "$work/stat.txt")
[ "${cells:-0}" -gt 0 ] || { echo "$config: no cell was made"; exit 1; }
echo "[figure] $config: $modules modules, $((elaborated - 1)) elaborated, $cells cells"
