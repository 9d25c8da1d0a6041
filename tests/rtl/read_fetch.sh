#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# read_fetch.sh SOURCE_DIR WORK_DIR: the tools accept rtl/io with its defaults and at the ends of its parameters, and
# refuse values beyond.
set -eu
source=$1 work=$2
mkdir -p "$work"
files="$source/rtl/fastsplat_ram_1r1w.sv $source/rtl/io/fastsplat_queue.sv $source/rtl/io/fastsplat_fetch.sv"
lint() { verilator --lint-only -Wall --assert --top-module fastsplat_fetch "-I$source/rtl" "$@" $files >"$work/lint.log" 2>&1; }
read=0
for given in "" "-GBURST=1 -GDEPTH_LOG2=1 -GOUTSTANDING=2 -GSETS_LOG2=1 -GADDRESS_BITS=16" "-GBURST=128 -GDEPTH_LOG2=10 -GOUTSTANDING=1024" "-GADDRESS_BITS=40 -GOUTSTANDING=5"; do
  lint $given || { cat "$work/lint.log"; echo "read_fetch.sh: Verilator refuses '$given'"; exit 1; }
  read=$((read + 1))
done
# M-fetch-23: the defaults and the ends of the ranges above are accepted, values beyond are refused.
refused=0
for given in -GBURST=0 -GBURST=129 "-GBURST=16 -GDEPTH_LOG2=3" -GOUTSTANDING=1 -GOUTSTANDING=2000 -GADDRESS_BITS=15 -GADDRESS_BITS=65 -GSETS_LOG2=0 -GSETS_LOG2=32 "-GBURST=1 -GDEPTH_LOG2=0" -GDEPTH_LOG2=17; do
  if lint $given; then echo "read_fetch.sh: takes '$given'"; exit 1; fi
  grep -q 'not [0-9]* to [0-9]*' "$work/lint.log" || { cat "$work/lint.log"; echo "read_fetch.sh: '$given' is refused for another reason"; exit 1; }
  refused=$((refused + 1))
done
yosys -q -l "$work/yosys.log" -p "read_verilog -sv -I$source/rtl $files; hierarchy -check -top fastsplat_fetch; proc; opt_clean; check -assert; tee -o $work/stat.txt stat" >/dev/null 2>&1 ||
  { tail -5 "$work/yosys.log"; echo "read_fetch.sh: Yosys fails"; exit 1; }
if command -v iverilog >/dev/null; then
  iverilog -g2012 -t null -s fastsplat_fetch "-I$source/rtl" $files >"$work/icarus.log" 2>&1 || { cat "$work/icarus.log"; echo "read_fetch.sh: Icarus fails"; exit 1; }
  echo "[figure] Icarus reads it = 1"
fi
echo "[figure] parameters read = $read, refused = $refused"
