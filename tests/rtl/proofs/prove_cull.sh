#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_cull.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR: what the cull unit calls hidden is, on 2 x 2 blocks of 2 x 2 pixels, with Yosys and z3:
# windows for any map, the tables of the first sheets of a tile (NAME_proof.svh). What is asked about happens; planted faults are noticed.
# Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line.
set -eu
emit=$1 source=$2 work=$3
. "$source/tests/rtl/proofs/common.sh"
depth=18

package_file="$work/cull_pkg.sv"
package TILE_WIDTH=4 TILE_HEIGHT=4 SIDE_BITS=3 ORG_BITS=6 RLUT_COLUMNS=4 WINDOWS_X=2 ADDR_BITS=2 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 \
  CULL_MAP=1 CULL_CELL_BITS=2 CULL_ROWS=2 CULL_BITS=3 CULL_WORDS=2 CULL_CHUNKS=1 CULL_ADDR_BITS=1 >"$package_file"

# bounded NAME DEPTH PROPERTY: from reset on for so many cycles
bounded() {
  if passed_over "$1"; then return; fi
  from=$(date +%s.%N)
  bmc "$1" "" "$2" || { tail -20 "$work/$1.out"; echo "$1: not proved within $2 cycles"; exit 1; }
  proved "$3" "the first $2 cycles of a tile" "$from"
  echo "[figure] $3: for the first $2 cycles, $(seconds "$from") s"
}

windows() { unit "$1" cull_windows "" "" "${2:+cull_windows}" "${2-}"; }
windows cull_windows
holds cull_windows 1 "cull_windows: a window is left out if and only if each of its pixels in the tile lies in an opaque block"
happens cull_windows 1
windows_broken() { windows "cull_windows_$1" "$2"; refuted "cull_windows_$1" 1; }
windows_broken second_column "s/seen\[b\] && between_x;/1'b0;/"
windows_broken row_below "s/(!second_out \&\& !row_below_i\[b\])/1'b0/"
windows_broken behind_the_last_pixel "s/first_out = row < 0 || .*;/first_out = row < 0;/"

map() { unit "$1" cull_map "cull_table ram_1r1w" "" "${2:+$2}" "${3-}"; }
map cull_map
bounded cull_map $depth "cull_map: a test is answered by the blocks that were opaque when the last sheet but one had been composited"
happens cull_map $depth
map_broken() { map "cull_map_$1" "$2" "$3"; refuted "cull_map_$1" $depth; }
map_broken of_today cull_map "s/assign copy\[p\*BY+r\] = copy_q;/assign copy[p*BY+r] = row_q;/"
map_broken a_cycle_early cull_map "s/assign leaves = finish_q\[6\]/assign leaves = finish_q[5]/"
map_broken not_above cull_map "s/(chunks == (BXL + 1)'(1) \&\& !b1_begin_q) ? sums_q/1'b0 ? sums_q/"
map_broken a_corner cull_table "s/words\[3\] - words\[2\]/words[3] - words[0]/"
