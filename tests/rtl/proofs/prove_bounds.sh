#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_bounds.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR: the outputs of slab opacity and compositing stay within their bounds
# for any words (NAME_proof.svh), in every mode and for ever. Proved by induction, with Yosys and z3; planted faults are
# noticed. Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line.
set -eu
emit=$1 source=$2 work=$3
. "$source/tests/rtl/proofs/common.sh"

# --- slab opacity: tiny's own words, of 11 bits; the factor table holds any legal words
package_file="$work/tiny.sv"
slab() { unit "$1" slab_opacity "" ram_1r1w "${2:+slab_opacity}" "${2-}"; }
slab slab_opacity
holds slab_opacity 2 "slab_opacity: factor between its segment's ends, colour and opacity in 0..1 and half a unit off, sums unchanged; words of 11 bits"
happens slab_opacity 6
slab_broken() { slab "slab_opacity_$1" "$2"; refuted "slab_opacity_$1" 6; }
slab_broken factor_rises 's/factor_k3_q <= segment_k2\[2\*FB-1:FB\] - FB/factor_k3_q <= segment_k2[2*FB-1:FB] + FB/'
slab_broken sums_counted_as_cut "s/slab_o\[c\*DB+:DB\]} <= {1'b0, DB'(sum_k3_q)};/slab_o[c*DB+:DB]} <= {1'b1, DB'(sum_k3_q)};/"
slab_broken opacity_not_scaled 's/(c == 3) ? widened(narrow_added_opacity(sum_k3_q)) :/(c == 3) ? {1'"'"'b0, LB'"'"'(sum_k3_q)} :/'

# --- compositing: words of 7 bits, for z3 has to reason about products
package_file="$work/composite_pkg.sv"
package STATE_BITS=7 TRANS_BITS=7 SHEET_BITS=7 TRANS_FRAC=6 SHIFT_LIGHT=6 SHIFT_ABSORBED=6 >"$package_file"
composite() { unit "$1" composite_lane "" "" "${2:+composite_lane}" "${2-}"; }
composite composite_lane
holds composite_lane 2 "composite_lane: transmittance in 0..1, never rises or wraps; colour never falls, gains T at most; terminated pixels stay; sums saturate; 7 bits"
happens composite_lane 6
composite_broken() { composite "composite_lane_$1" "$2"; refuted "composite_lane_$1" 6; }
composite_broken transmittance_rises "s/{1'b0, state - light}/{1'b0, state + light}/"
composite_broken frozen_too_late "s/transmittance < TB'(fastsplat_pkg::FREEZE_BELOW)/transmittance <= TB'(fastsplat_pkg::FREEZE_BELOW)/"
composite_broken light_of_the_state 's/narrow_light((2 \* TB).(transmittance) \* (2 \* TB).(slab_i\[c\*DB+:TB\]))/narrow_light((2 * TB)'"'"'(state_i[c*DB+:TB]) * (2 * TB)'"'"'(slab_i[c*DB+:TB]))/'
composite_broken frozen_moves "s/else if (frozen) stepped/else if (frozen \&\& !is_transmittance) stepped/"
