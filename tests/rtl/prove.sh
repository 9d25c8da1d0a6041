#!/bin/sh
# prove.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR FAULT_PACKAGE: formal proofs with Yosys and z3, and that each proof notices a
# planted fault. Words are cut to a few bits: forwarding does not depend on their width. Memories of four words are registers to z3:
# fifty times faster than its arrays.
set -eu
emit=$1 source=$2 work=$3 faults=$4
mkdir -p "$work"
"$emit" "$source/configs/tiny.toml" | sed -e 's/\(localparam int \(STATE_BITS\|TRANS_BITS\)\) = .*;/\1 = 3;/' \
  -e 's/\(localparam int SHEET_BITS\) = .*;/\1 = 2;/' \
  -e 's/\(localparam int \(TRANS_FRAC\|PIXEL_BITS\)\) = .*;/\1 = 2;/' \
  -e 's/\(localparam int ADDR_BITS\) = .*;/\1 = 2;/' -e 's/\(localparam int SIDE_BITS\) = .*;/\1 = 3;/' -e 's/\(localparam int \(BLOCKS_X\|BLOCKS_Y\)\) = .*;/\1 = 2;/' \
  -e 's/\(localparam int BLOCKS\) = .*;/\1 = 4;/' -e 's/\(localparam int BLK_BITS\) = .*;/\1 = 1;/' >"$work/fastsplat_pkg.sv"

# smt NAME TOP FILES DEFINES...: writes NAME.smt2
smt() {
  name=$1 top=$2 files=$3
  shift 3
  yosys -q -l "$work/$name.log" -p "read_verilog -sv -formal $* -I$source/rtl -I$source/tests/rtl $work/fastsplat_pkg.sv $faults $files; hierarchy -check -top $top; proc; flatten; delete -output o:*; memory_map; opt -full -purge; async2sync; dffunmap; opt_clean; check -assert; write_smt2 -wires $work/$name.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$name.log"; echo "$name: Yosys fails"; exit 1; }
}
holds() { # NAME MODE DEPTH
  yosys-smtbmc -s z3 --unroll $2 -t "$3" --noprogress "$work/$1.smt2" >"$work/$1.$3.out" 2>&1 ||
    { tail -30 "$work/$1.$3.out"; echo "$1: not proved (${2:-bounded}, $3)"; exit 1; }
}
refuted() { # NAME DEPTH
  if yosys-smtbmc -s z3 --unroll -t "$2" --noprogress "$work/$1.smt2" >"$work/$1.out" 2>&1; then
    echo "$1: the planted fault is not found within $2 cycles"; exit 1
  fi
  grep -q 'Assert failed' "$work/$1.out" || { tail -5 "$work/$1.out"; echo "$1: fails for another reason"; exit 1; }
  echo "[figure] planted $1: $(grep -m1 'Assert failed' "$work/$1.out" | sed 's/.*Assert failed in/assertion failed in/')"
}

bank="$source/rtl/sheet_bank.sv $source/rtl/ram_1r1w.sv"

smt sheet_bank sheet_bank "$bank" -DFASTSPLAT_PROOF
grep -q 'yosys-smt2-assert' "$work/sheet_bank.smt2" || { echo "sheet_bank: nothing to prove"; exit 1; }
from=$(date +%s.%N)
holds sheet_bank "" 14
holds sheet_bank -i 6
holds sheet_bank -c 20
echo "sheet_bank: forwarding gives every sum, if a memory has one owner at a time | induction over 6 cycles | $(awk -v from="$from" -v to="$(date +%s.%N)" 'BEGIN { printf "%.1f", to - from }')" >"$work/proofs.txt"
echo "[figure] sheet_bank: forwarding holds for 14 cycles after power-up, and by induction over 6 for ever"

for fault in FORWARD_1 FORWARD_2 FORWARD_3 FORWARD_BUFFER MISSED_CLEAR MISSED_WIPE; do
  smt $fault sheet_bank "$bank" -DFASTSPLAT_PROOF -DFASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::$fault
  refuted $fault 14
done
