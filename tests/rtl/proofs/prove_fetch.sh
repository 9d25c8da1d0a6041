#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_fetch.sh SOURCE_DIR WORK_DIR: the top's register slice, the fetch master's queue and what it does on the memory's port, for ever, by induction, with Yosys and z3; that
# what is asked about happens; planted faults are noticed. Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line.
set -eu
source=$1 work=$2
. "$source/tests/rtl/proofs/common.sh"

# smt NAME MODULE PARAMETERS [EDIT]: NAME.smt2 of MODULE with its specification inside, the modules in it with free outputs; EDIT breaks a line of it.
smt() {
  if passed_over "$1"; then return; fi
  name=$1 module=$2 parameters=$3 edit=${4-}
  with_spec "$module" "$here/${module}_proof.svh" >"$work/$name.sv"
  [ -z "$edit" ] || broken "$work/$name.sv" "$edit"
  beside=$(file_of ram_1r1w)
  [ "$module" = queue ] || beside="$beside $(file_of queue)"
  yosys -q -l "$work/$name.log" -p "read_verilog -sv -formal -I$source/rtl $work/$name.sv $beside; chparam $parameters fastsplat_$module; hierarchy -check -top fastsplat_$module; proc; cutpoint t:*fastsplat_ram_1r1w* t:*fastsplat_queue*; flatten; delete -output o:*; opt -full; async2sync; dffunmap; opt_clean; check -assert; write_smt2 -wires $work/$name.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$name.log"; echo "$name: Yosys fails"; exit 1; }
  grep -q 'yosys-smt2-assert' "$work/$name.smt2" || { echo "$name: nothing to prove"; exit 1; }
}

few="-set BITS 3 -set LOG2 2"
smt queue queue "$few"
holds queue 2 "queue: all words put in come out, in order, in their cycle; four words of three bits"
happens queue 14
queue_broken() { smt "queue_$1" queue "$few" "$2"; refuted "queue_$1" 12; }
queue_broken reads_too_much "s/(!shown_q || take_i)/1'b1/"
queue_broken not_held "s/shown_q <= read || .*/shown_q <= read;/"
queue_broken half_as_fast "s/(!shown_q || take_i)/!shown_q/"
queue_broken late "s/assign read = put_q != read_q \&\&/assign read = put_q - read_q > (LOG2 + 1)'(1) \&\&/"

smt slice slice "-set BITS 3"
holds slice 2 "slice: what is taken comes out, in order, one cycle later, and is held until it is taken; a transfer a cycle; three bits"
happens slice 6
slice_broken() { smt "slice_$1" slice "-set BITS 3" "$2"; refuted "slice_$1" 8; }
slice_broken withdrawn "s/assign moves = .*/assign moves = 1'b1;/"
slice_broken loses_the_spare "s/valid_o <= spare_q || taken/valid_o <= taken/"
slice_broken wrong_word "s/spare_q ? spare_data_q : data_i/spare_q ? data_i : spare_data_q/"
slice_broken takes_a_third "s/ready_o <= moves || .*/ready_o <= 1'b1;/"
slice_broken half_as_fast "s/ready_o <= moves || .*/ready_o <= moves \&\& !taken;/"

small="-set ADDRESS_BITS 16 -set BURST 4 -set DEPTH_LOG2 3 -set OUTSTANDING 3 -set SETS_LOG2 2 -set JUDGED_LOG2 3"
smt fetch fetch "$small"
# M-fetch-12, M-fetch-13: the module's own assertions
holds fetch 2 "fetch: ARVALID, its address and beats stay, bursts lie within 4 KB and their run and have room, sets have room; bursts of 4, 8 beats, 3 under way, 8 sets"
happens fetch 24
fetch_broken() { smt "fetch_$1" fetch "$small" "$2"; refuted "fetch_$1" "${3:-14}"; }
fetch_broken valid_dropped "s/^    if (!m_axi_arvalid || m_axi_arready) begin/    if (1'b1) begin/"
fetch_broken over_page 's/32.(to_page) < 32.(BURST) \&\&/32'"'"'(to_page) > 32'"'"'(BURST) \&\&/'
fetch_broken no_room "s/(room_q >= DB'(BURST) ||/(room_q >= DB'(1) ||/"
fetch_broken room_twice "s/ + DB'(sends);\$/ + DB'(m_axis_tvalid);/"
fetch_broken one_too_many "s/outstanding_q < OB'(OUTSTANDING)/outstanding_q <= OB'(OUTSTANDING)/"
fetch_broken withdrawn 's/ || stop_q || held_q);/ || stop_q);/' 22
fetch_broken judges_too_many "s/assign judged_full = .*/assign judged_full = 1'b0;/" 22
fetch_broken gap 's/address_q <= address_q + (AB.(burst)/address_q <= address_q + (AB'"'"'(BURST)/'
fetch_broken asks_hidden "s/(verdict_hidden \&\& !\`FASTSPLAT_FAULT(FETCH_HIDDEN_TOO))/1'b0/"
