#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR FAULT_PACKAGE: formal proofs with Yosys and z3, and that each proof notices a
# planted fault. Words are cut to a few bits: forwarding does not depend on their width. Memories of four words are registers to z3:
# fifty times faster than its arrays.
set -eu
emit=$1 source=$2 work=$3 faults=$4
. "$source/tests/rtl/proofs/common.sh"
package STATE_BITS=3 TRANS_BITS=3 SHEET_BITS=2 TRANS_FRAC=2 PIXEL_BITS=2 ADDR_BITS=2 SIDE_BITS=3 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 >"$work/fastsplat_pkg.sv"

# smt NAME TOP FILES DEFINES...: writes NAME.smt2
smt() {
  if passed_over "$1"; then return; fi
  name=$1 top=$2 files=$3
  shift 3
  yosys -q -l "$work/$name.log" -p "read_verilog -sv -formal $* -I$source/rtl -I$source/tests/rtl $work/fastsplat_pkg.sv $faults $files; hierarchy -check -top $(rtl_of "$top"); proc; flatten; delete -output o:*; memory_map; opt -full -purge; async2sync; dffunmap; opt_clean; check -assert; write_smt2 -wires $work/$name.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$name.log"; echo "$name: Yosys fails"; exit 1; }
}
bank="$(file_of sheet_bank) $(file_of ram_1r1w)"

smt sheet_bank sheet_bank "$bank" -DFASTSPLAT_PROOF
passed_over sheet_bank || grep -q 'yosys-smt2-assert' "$work/sheet_bank.smt2" || { echo "sheet_bank: nothing to prove"; exit 1; }
holds sheet_bank 6 "sheet_bank: forwarding gives every sum, if a memory has one owner at a time"
happens sheet_bank 20

for fault in FORWARD_1 FORWARD_2 FORWARD_3 FORWARD_BUFFER MISSED_CLEAR MISSED_WIPE; do
  smt $fault sheet_bank "$bank" -DFASTSPLAT_PROOF -DFASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::$fault
  refuted $fault 14
done
