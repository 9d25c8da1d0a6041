#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_control.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR [short]: the device's control for ever, by induction, with Yosys and z3, each part
# against its specification written again (NAME_proof.svh): check, decode, the dirty walk, the compositor's pipe. What each assumes of the others is
# proved in prove_core.sh. What is asked about happens; planted faults are noticed.
# Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line. short: without what takes minutes to reach or to refute, and most
# of the faults.
set -eu
emit=$1 source=$2 work=$3 short=${4-}
. "$source/tests/rtl/proofs/common.sh"

# --- check: two radius sets of two phases and up to 8 columns, tables of a few words; words of any value
package_file="$work/check_pkg.sv"
package RLUT_SETS=2 RLUT_COLUMNS=8 COL_BITS=4 PHASES=2 PHASE_LOG2=1 PHASE_BITS=1 RHO_MOST=8 RADIAL_ENTRIES=2 RADIAL_WORDS=2 RADIAL_LOG2=1 SEGMENTS=8 SEG_LOG2=3 >"$package_file"
check() { without=FASTSPLAT_ASS unit "$1" stream_check "record_rules word_rules" "" "${2:+stream_check}" "${2-}"; }
check stream_check
holds stream_check 1 "stream_check: legal beats pass once, in order; the first illegal one is reported, and open sheets and tiles are closed"
check_broken() { defines=-DF_FEW_BEATS check "stream_check_$1" "$2"; refuted "stream_check_$1" "${3:-8}"; }
if [ -z "$short" ]; then
  without="FASTSPLAT_ASS\\|FASTSPLAT_COVER" defines=-DF_FEW_BEATS unit stream_check_few stream_check "record_rules word_rules" ""
  happens stream_check_few 8
  check_broken taken_back_beat_passes_twice "s/^    if (leaves) beat_valid_q <= 1'b0;.*//"
fi

# --- decode: two radius sets of two phases and up to 8 columns: 1 to 4 x 4 windows of 2 x 2 lanes
package_file="$work/decode_pkg.sv"
package RLUT_SETS=2 RLUT_COLUMNS=8 COL_BITS=4 PHASES=2 PHASE_LOG2=1 PHASE_BITS=1 >"$package_file"
decode() { unit "$1" stream_decode "" "" "${2:+stream_decode}" "${2-}"; }
decode stream_decode
holds stream_decode 2 "stream_decode: no beat lost, doubled or out of order; each window of a splat once, each table word in its place"
decode_broken() { decode "stream_decode_$1" "$2"; refuted "stream_decode_$1" "${3:-8}"; }
decode_broken one_window_more "s/\(extent_q\[.*\] <= extent_i\);/\1 + COL'(P);/"
if [ -z "$short" ]; then
  happens stream_decode 20
  decode_broken beat_twice 's/assign ready_o = !beat_valid_q || take;/assign ready_o = !beat_valid_q || (take \&\& !payload_q);/'
  decode_broken beat_lost 's/else if (wait_buffer || wait_tile) take = 1.b0;/else if (wait_tile) take = 1'"'"'b0;/' 14
  decode_broken window_twice 's/else if (is_splat) take = last_window;/else if (is_splat) take = last_window \&\& window_valid_o;/' 9:12
  decode_broken columns_of_one_phase "s/table_column_q + COL'(1) == table_extent_q/table_column_q == table_extent_q/"
  decode_broken wrong_buffer 's/window_buffer_o <= buffer_q;/window_buffer_o <= !buffer_q;/'
fi

# --- the walk: 4 x 4 blocks; any block of any buffer is looked at
package_file="$work/dirty_map_pkg.sv"
package ADDR_BITS=4 BLOCKS_X=4 BLOCKS_Y=4 BLOCKS=16 BLK_BITS=2 >"$package_file"
walk() { unit "$1" dirty_map "" "" "${2:+dirty_map}" "${2-}"; }
walk dirty_map
holds dirty_map 2 "dirty_map: each marked block once, rising, one a cycle, in its cycle, clean afterwards; no other"
happens dirty_map 16
walk_broken() { walk "dirty_map_$1" "$2"; refuted "dirty_map_$1" "${3:-16}"; }
walk_broken stays_dirty "s/ || (fetched_q\[r\] \&\& fetched_buffer_q == 1'(m))//"
walk_broken gap_between_rows "s/one_left_q <= rest == '0;/one_left_q <= f3_rest_q == '0;/"
if [ -z "$short" ]; then
  walk_broken other_buffer_cleared "s/(advance \&\& buffer_q == 1'(m)) ? f1_row/advance ? f1_row/"
  walk_broken row_end_is_the_end 's/assign finish = go \&\& one_left_q \&\& !f2_valid_q;/assign finish = go \&\& one_left_q;/'
  walk_broken marks_missed 's/if (mark_y\[r\] \&\& mark_buffer_i/if (mark_y[r] \&\& !f1_row_q[r] \&\& mark_buffer_i/'
  walk_broken waits_for_the_sums 's/assign start = state_q == StIdle \&\& marked_q\[buffer_q\];/assign start = state_q == StIdle \&\& full_q[buffer_q];/'
  walk_broken early_row "s/assign walking = state_q == StWalk \&\& full_q/assign walking = (state_q == StWalk || state_q == StBlocks) \&\& full_q/"
fi

package_file="$work/dirty_map_slices_pkg.sv"
package ADDR_BITS=4 BLOCKS_X=4 BLOCKS_Y=4 BLOCKS=16 BLK_BITS=2 COMPOSITE_LANES=1 SLICES=4 SLICE_BITS=2 >"$package_file"
walk dirty_map_slices
holds dirty_map_slices 2 "dirty_map: the same where a block is four slices: each of them once, in order"
happens dirty_map_slices 18
walk_broken slice_lost "s/(fastsplat_pkg::SLICES - 1) || f3_row_q/(fastsplat_pkg::SLICES - 2) || f3_row_q/"

# --- the compositor's pipe and picture: 2 x 2 blocks of words of a few bits, and memories that return any value when
# they read the word being written
package_file="$work/compositor_pkg.sv"
package STATE_BITS=3 TRANS_BITS=3 SHEET_BITS=2 TRANS_FRAC=2 PIXEL_BITS=2 SIDE_BITS=4 ADDR_BITS=2 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 >"$package_file"
probes=""
for lane in 0 1 2 3; do
  memory="gen_row[$((lane / 2))].gen_bank[$((lane % 2))].u_picture"
  probes="$probes connect -nounset -set $memory.probe_addr_i f_block; connect -nounset -set f_memory$lane $memory.probe_o;"
done
pipe() { connects=$probes defines=-DFASTSPLAT_PROOF unit "$1" compositor "ram_1r1w" "dirty_map slab_opacity composite_lane" "${2:+compositor}" "${2-}"; }
pipe compositor
holds compositor 2 "compositor: picked in k0, written in k6; a picture word has one writer, is read as written last, and blank behind pixel out"
happens compositor 16
pipe_broken() { pipe "compositor_$1" "$2"; refuted "compositor_$1" "${3:-16}"; }
pipe_broken not_blanked "s/(wipe_i || sent_q) ? '0 : states/wipe_i ? '0 : states/"
if [ -z "$short" ]; then
  pipe_broken all_rows_blanked 's/(sent_q \&\& picture_row_i\[h\])/sent_q/'
  pipe_broken blanked_next_door 's/sent_addr_q <= picture_addr_i;/sent_addr_q <= picture_addr_i + AB'"'"'(1);/'
  pipe_broken rows_outside_written 's/(written \&\& inside_y_q\[h\])/written/'
  pipe_broken not_forwarded 's/(forward_q \&\& inside_y_q\[c\/P\]) ? states/1'"'"'b0 ? states/'
fi
for lanes in 1 2; do
  package_file="$work/compositor_lanes_pkg.sv"
  package STATE_BITS=3 TRANS_BITS=3 SHEET_BITS=2 TRANS_FRAC=2 PIXEL_BITS=2 SIDE_BITS=4 ADDR_BITS=2 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 \
    COMPOSITE_LANES=$lanes SLICES=$((4 / lanes)) SLICE_BITS=$((3 - lanes)) >"$package_file"
  pipe compositor_lanes_$lanes
  holds compositor_lanes_$lanes 2 "compositor: the same where a block is $((4 / lanes)) slices, and the tap has all of them"
  happens compositor_lanes_$lanes 20
  pipe_broken slice_of_the_next_$lanes "s/slice_q\[3\] == LB'(r)/slice_q[2] == LB'(r)/"
done
if [ -z "$short" ]; then
  pipe_broken first_slice_kept "s/assign written = valid_q\[6\] \&\& (R == 1 || slice_q\[6\] == LB'(B \/ C));/assign written = valid_q[6] \&\& slice_q[6] == '0;/"
fi
