#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_core.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR [short]: how the device's parts share the sheet buffers, what each part's proof (prove_control.sh)
# assumes of the others, and that something always moves, for ever, by induction, with Yosys and z3. What is asked about happens; planted faults are
# noticed.
# Leaves WORK_DIR/proofs.txt as prove_control.sh does. short: without the deadlock's proof, the covers and the faults, which take minutes.
set -eu
emit=$1 source=$2 work=$3 short=${4-}
. "$source/tests/rtl/proofs/common.sh"

# 2 x 2 blocks, the data path cut off
core_package() { # OTHER VALUES
  package_file="$work/core_pkg.sv"
  package STATE_BITS=3 TRANS_BITS=3 SHEET_BITS=2 TRANS_FRAC=2 PIXEL_BITS=2 SIDE_BITS=3 RLUT_SETS=2 ADDR_BITS=2 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 "$@" >"$package_file"
}
core_package
connects=""
for pair in f_beat=u_decode.beat_valid_q f_payload=u_decode.payload_q f_take=u_decode.take f_splat=u_decode.is_splat f_kind_splat=u_decode.splat_q f_kind_sheet=u_decode.begins_sheet_q f_kind_rest=u_decode.waits_for_rest_q f_table=u_decode.table_write \
  f_begin=u_decode.tile_begin f_opcode=u_decode.opcode f_busy=u_decode.busy_q f_buffer=u_decode.buffer_q \
  f_idle_walk=u_compositor.walk_idle f_issue=u_compositor.issue f_blocks=u_compositor.valid_q f_valid_below=u_splat.valid_q \
  f_pixel_running=u_pixel_out.running_q f_pixel_r1=u_pixel_out.valid_r1_q f_pixel_r2=u_pixel_out.valid_r2_q f_last_below=u_splat.last_q f_buffer_below=u_splat.buffer_q f_idle_pixel=u_pixel_out.idle_o f_here=u_check.beat_valid_q f_soft=u_check.reset_q f_check_place=u_check.place_q \
  f_still=u_compositor.still_q f_next_here=u_check.next_valid_q f_check_opcode=u_check.opcode f_check_wants=u_check.record_place_q; do
  connects="$connects connect -nounset -set ${pair%=*} ${pair#*=};"
done
specification=core
core() { unit "$1" fastsplat_core "stream_check stream_decode splat_array delay compositor pixel_out" "record_rules word_rules snap rlut axis lane sheet_bank dirty_map slab_opacity composite_lane csr popcount ram_1r1w parameters" "${2-}" "${3-}"; }
core_shares="core: one owner of a memory at a time, and the mutual assumptions of the parts' proofs"
moves="something moves within 12 cycles"
sliced="core: the same where a block is four slices"
slices() { core_package COMPOSITE_LANES=1 SLICES=4 SLICE_BITS=2; }
if [ -n "$short" ]; then
  without="No deadlock" core core
  holds core 2 "$core_shares"
  slices
  without="No deadlock" core core_slices
  holds core_slices 2 "$sliced"
  exit
fi
core_broken() { core "core_$1" "$2" "$3"; refuted "core_$1" "$4"; }
core core
holds core 15 "$core_shares; $moves"
happens core 31
core_broken marked_late splat_array 's/: last_q\[4\];/: last_q[5];/; s/: buffer_q\[4\];/: buffer_q[5];/' 18:25
core_broken end_frame_stays stream_decode "s/if (wait_hazard) take = 1'b0;/if (wait_hazard || (!payload_q \&\& opcode == fastsplat_pkg::OP_END_FRAME)) take = 1'b0;/" 19:26
slices
core core_slices
holds core_slices 15 "$sliced; $moves"
core_broken early_swap splat_array 's/: last_q\[WRITTEN\];/: last_q[6];/; s/: buffer_q\[WRITTEN\];/: buffer_q[6];/' 18:25
