#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# read_strict.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR: every file of rtl/ is its own compilation unit. It includes all files
# that it uses, uses no name before its declaration, and has no implicit net. Read by Icarus (-u), Verilator and Yosys,
# for configurations that together have every feature.
set -eu
emit=$1 source=$2 work=$3
mkdir -p "$work"
fails() { tail -5 "$1"; echo "read_strict.sh: $2"; exit 1; }

files=0
for file in "$source"/rtl/*.sv "$source"/rtl/*/*.sv; do
  verilator -E "-I$source/rtl" "$file" >"$work/alone.sv" 2>"$work/verilator.log" || fails "$work/verilator.log" "$file: Verilator refuses it"
  ! grep '`FASTSPLAT' "$work/alone.sv" || { echo "read_strict.sh: $file uses a macro that it does not include"; exit 1; }
  files=$((files + 1))
done
python3 -B "$source/tests/rtl/declared_first.py" "$source"/rtl/*.sv "$source"/rtl/*/*.sv || { echo "read_strict.sh: a signal is used above its declaration"; exit 1; }
configurations=0
for config in tiny ellipse faults/cull faults/post faults/westover; do
  "$emit" "$source/configs/$config.toml" >"$work/fastsplat_pkg.sv"
  for top in fastsplat_top fastsplat_fetch; do
    if command -v iverilog >/dev/null; then
      iverilog -g2012 -u -Wall "-I$source/rtl" -o "$work/read.vvp" -s "$top" "$work/fastsplat_pkg.sv" "$source"/rtl/*.sv "$source"/rtl/*/*.sv >"$work/icarus.log" 2>&1 ||
        fails "$work/icarus.log" "$config: Icarus refuses $top"
      ! grep implicit "$work/icarus.log" || fails "$work/icarus.log" "$config: Icarus finds an implicit net in $top"
    fi
  done
  {
    echo "read_verilog -sv $work/fastsplat_pkg.sv"
    for file in "$source"/rtl/*.sv "$source"/rtl/*/*.sv; do
      echo "verilog_defines -reset"
      echo "read_verilog -sv -I$source/rtl $file"
    done
    echo "hierarchy -check -top fastsplat_top"
  } >"$work/read.ys"
  yosys -q -l "$work/yosys.log" "$work/read.ys" >/dev/null 2>&1 || fails "$work/yosys.log" "$config: Yosys refuses the RTL file by file"
  ! grep -i "implicit\|used before" "$work/yosys.log" || fails "$work/yosys.log" "$config: Yosys finds an implicit net"
  configurations=$((configurations + 1))
done
[ "$files" -gt 40 ]
echo "[figure] files read alone = $files, configurations = $configurations"
