#!/bin/sh
# prove_control.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR [short]: the device's control for ever, by induction, with Yosys and z3, each part
# against its specification written again (NAME_proof.svh): decode, the compositor's walk, and how the parts share the sheet
# buffers (core), with what each assumes of the others proved there. What is asked about happens; planted faults are noticed.
# Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line. short: without the deadlock's proof, what takes minutes to reach
# or to refute, and most of the faults.
set -eu
emit=$1 source=$2 work=$3 short=${4-}
[ -z "$short" ] || [ "$short" = short ] || { echo "prove_control.sh: not '$short' but short" >&2; exit 2; }
mkdir -p "$work"
here="$source/tests/rtl/proofs"
. "$here/common.sh"
: >"$work/proofs.txt"
"$emit" "$source/configs/tiny.toml" >"$work/tiny.sv"

# --- decode: two radius sets of two phases and up to 8 columns: 1 to 4 x 4 windows of 2 x 2 lanes
package_file="$work/decode_pkg.sv"
package RLUT_SETS=2 RLUT_COLUMNS=8 COL_BITS=4 PHASES=2 PHASE_LOG2=1 PHASE_BITS=1 >"$package_file"
decode() { unit "$1" stream_decode "" "" "${2:+stream_decode}" "${2-}"; }
decode stream_decode
holds stream_decode 2 "stream_decode: no beat lost, doubled or out of order; each window of a splat once, each table word in its place"
decode_broken() { decode "stream_decode_$1" "$2"; refuted "stream_decode_$1" "${3:-8}"; }
decode_broken one_window_more "s/COL'((header_pixels + RHO2'(P - 1))/COL'((header_pixels + RHO2'(P))/"
if [ -z "$short" ]; then
  happens stream_decode 18
  decode_broken beat_twice 's/assign ready_o = enable_i \&\& (!beat_valid_q || take);/assign ready_o = enable_i \&\& (!beat_valid_q || (take \&\& !payload_q));/'
  decode_broken beat_lost 's/else if (wait_buffer || wait_tile) take = 1.b0;/else if (wait_tile) take = 1'"'"'b0;/' 14
  decode_broken window_twice 's/else if (is_splat) take = last_window;/else if (is_splat) take = last_window \&\& window_valid_o;/' 9:12
  decode_broken columns_of_one_phase "s/table_column_q + COL'(1) == table_extent_q/table_column_q == table_extent_q/"
  decode_broken wrong_buffer 's/window_buffer_o <= buffer_q;/window_buffer_o <= !buffer_q;/'
fi

# --- the walk: 4 x 2 blocks; any block of any buffer is looked at, data is cut off
package_file="$work/compositor_pkg.sv"
package STATE_BITS=3 TRANS_BITS=3 SHEET_BITS=2 TRANS_FRAC=2 PIXEL_BITS=2 ADDR_BITS=3 BLOCKS_X=4 BLOCKS_Y=2 BLOCKS=8 BLK_BITS=2 >"$package_file"
walk() { unit "$1" compositor "" "slab_opacity composite_lane ram_1r1w" "${2:+compositor}" "${2-}"; }
walk compositor
holds compositor 2 "compositor: each marked block once, rising, one a cycle, in its cycle, clean afterwards; no other"
happens compositor 14
walk_broken() { walk "compositor_$1" "$2"; refuted "compositor_$1" "${3:-9}"; }
walk_broken stays_dirty "s/\& ~(pick_y\[r\] ? pick_x_of\[m\] : '0);/;/"
if [ -z "$short" ]; then
  walk_broken other_buffer_cleared "s/assign pick_x_of\[m\] = walk_buffer_q == 1'(m) ? pick_x : '0;/assign pick_x_of[m] = pick_x;/"
  walk_broken row_end_is_the_end 's/assign finish = state_q == StWalk \&\& dirty_rows == pick_y \&\& row == pick_x;/assign finish = state_q == StWalk \&\& row == pick_x;/'
  walk_broken marks_missed 's/(row_q\[m\] | (mark_y\[r\] ? mark_x_of\[m\] : .0))/(pick_y[r] ? row_q[m] : row_q[m] | (mark_y[r] ? mark_x_of[m] : '"'"'0))/'
  walk_broken picture_forgotten 's/if (issue) touched_q\[pick\] <= 1.b1;/if (issue \&\& !any) touched_q[pick] <= 1'"'"'b1;/'
fi

# --- the whole: 2 x 2 blocks, the data path cut off
package_file="$work/core_pkg.sv"
package STATE_BITS=3 TRANS_BITS=3 SHEET_BITS=2 TRANS_FRAC=2 PIXEL_BITS=2 SIDE_BITS=3 RLUT_SETS=2 ADDR_BITS=2 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 >"$package_file"
connects=""
for pair in f_beat=u_decode.beat_valid_q f_payload=u_decode.payload_q f_take=u_decode.take f_splat=u_decode.is_splat f_table=u_decode.table_write \
  f_opcode=u_decode.opcode f_words=u_decode.w3 f_busy=u_decode.busy_q f_buffer=u_decode.buffer_q f_full=u_compositor.full_q \
  f_state=u_compositor.state_q f_walk=u_compositor.walk_buffer_q f_blocks=u_compositor.valid_q f_valid_below=u_splat.valid_q \
  f_last_below=u_splat.last_q f_buffer_below=u_splat.buffer_q f_idle_pixel=u_pixel_out.idle_o; do
  connects="$connects connect -nounset -set ${pair%=*} ${pair#*=};"
done
specification=core
core() { unit "$1" fastsplat_core "stream_decode splat_array compositor pixel_out" "snap rlut axis lane sheet_bank slab_opacity composite_lane csr ram_1r1w" "${2-}" "${3-}"; }
core_shares="core: one owner of a memory at a time, and what the parts' proofs assume of each other"
if [ -n "$short" ]; then
  without="No deadlock" core core
  holds core 2 "$core_shares"
  exit
fi
core core
holds core 15 "$core_shares; something moves within 12 cycles"
happens core 24
core_broken() { core "core_$1" "$2" "$3"; refuted "core_$1" "$4"; }
core_broken early_swap splat_array 's/: last_q\[9\];/: last_q[6];/; s/: buffer_q\[9\];/: buffer_q[6];/' 15:20
core_broken waits_for_both compositor "s/StIdle: if (full_q\[walk_buffer_q\]) state_q <= StWalk;/StIdle: if (full_q == 2'b11) state_q <= StWalk;/" 21:23
