#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# gates.sh CONFIG EMIT_PACKAGE SOURCE_DIR WORK_DIR: maps the device to static CMOS gates by Yosys; memories stay whole.
# Writes to WORK_DIR the files that fastsplat_evidence reads, as tests/rtl/synthesis/synth.sh does for FPGAs:
#   gates-CONFIG.stat      gates by module, hierarchy kept
#   gates-CONFIG.memories  bits of the memories by module
#   gates-CONFIG.levels    longest path of each module between registers, memories and its submodules
#   gates-CONFIG.tools     version, the configuration's hash, processor seconds
# CONFIG: a name in configs/.
set -eu
config=$1 emit=$2 source=$3 work=$4
mkdir -p "$work"
base="$work/gates-$config"
"$emit" "$source/configs/$config.toml" >"$base.pkg.sv"
modules=$(sed -n 's/^module \([a-z0-9_]*\).*/\1/p' "$source"/rtl/*.sv "$source"/rtl/*/*.sv)
ends="t:\$_DFF_P_ t:\$mem_v2 t:*fastsplat_ram_1r1w"  # of paths
for module in $modules; do ends="$ends t:$module"; done
core=$(find "$source/rtl" -name '*.sv' -not -path '*/io/*' | sort)
yosys -q -l "$base.log" -p "read_verilog -defer -sv -I$source/rtl $base.pkg.sv $(echo $core); hierarchy -check -top fastsplat_core; proc; opt_clean; tee -o $base.memories stat; synth -run begin:fine -top fastsplat_core; memory_map */t:\$mem_v2 *fastsplat_ram_1r1w*/* %d; opt -fast -full; techmap; dfflegalize -cell \$_DFF_P_ x; abc -fast -g cmos; opt_clean; tee -o $base.stat.new stat; delete $ends; tee -o $base.levels ltp -noff" >/dev/null 2>&1 ||
  { tail -5 "$base.log"; echo "gates $config: Yosys fails"; exit 1; }
{
  sed -n 's/^\(Yosys [^ ]*\) .*/yosys \1/p' "$base.log" | tail -1
  hex() { sed -n "s/.* HASH_$1 = 32'h\([0-9a-f]*\);.*/\1/p" "$base.pkg.sv"; }
  echo "configuration $(hex HIGH)$(hex LOW)"
  sed -n 's/.*CPU: user \([0-9.]*\)s.*/seconds \1/p' "$base.log" | tail -1
} >"$base.tools"
mv -- "$base.stat.new" "$base.stat"
