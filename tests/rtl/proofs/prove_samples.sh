#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_samples.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR [short]: a device that composites every sample gives each pixel what samples one after another would
# give it, with Yosys and z3, on 2 x 2 lanes and blocks and words of a few bits (NAME_proof.svh). What is asked about happens; planted faults are noticed.
# short: with two of the loop's eight faults and one of decode's four, without the covers of decode: the others take minutes. Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line.
set -eu
emit=$1 source=$2 work=$3 short=${4-}
. "$source/tests/rtl/proofs/common.sh"

# --- the loop; memories give anything when they read what is written
package_file="$work/samples_pkg.sv"
package EVERY_SAMPLE=1 STATE_BITS=2 TRANS_BITS=2 SHEET_BITS=2 TRANS_FRAC=1 PIXEL_BITS=2 SIDE_BITS=4 ADDR_BITS=2 BLOCKS_X=2 BLOCKS_Y=2 BLOCKS=4 BLK_BITS=1 >"$package_file"
probes=""
for lane in 0 1 2 3; do
  memory="gen_row[$((lane / 2))].gen_bank[$((lane % 2))].u_picture"
  probes="$probes connect -nounset -set $memory.probe_addr_i f_block; connect -nounset -set f_memory$lane $memory.probe_o;"
done
for stage in 2 3 4 5 6; do
  for pair in column=column row=row in_x=inside_x in_y=inside_y; do
    probes="$probes connect -nounset -set f_${pair%=*}$stage gen_samples.u_places.${pair#*=}_q[$stage];"
  done
done
specification=samples
samples() { connects=$probes defines=-DFASTSPLAT_PROOF unit "$1" compositor "ram_1r1w sample_places" "dirty_map slab_opacity composite_lane" "${2:+$2}" "${3-}"; }
samples samples
holds samples 2 "compositor, every sample: a sample is put over the result of the one before, 2 or more cycles ago; the picture is the last result"
happens samples 20
samples_broken() { samples "samples_$1" "$2" "$3"; refuted "samples_$1" 20; }
samples_broken not_after_2 sample_places 's/assign forward_2_o\[B\] = /&1'"'b0 \&\& /"
samples_broken one_address compositor 's/sampling \&\& !wipe_i \&\& !sent_q) ? sample_waddr\[B\*AB+:AB\]/sampling \&\& !wipe_i \&\& !sent_q) ? sample_waddr[0+:AB]/'
if [ -z "$short" ]; then
  samples_broken not_after_3 sample_places 's/assign forward_3_o\[B\] = /&1'"'b0 \&\& /"
  samples_broken not_after_4 sample_places 's/assign forward_4_o\[B\] = /&1'"'b0 \&\& /"
  samples_broken oldest_counts compositor 's/sample_forward_2\[c\] ? next : sample_forward_3\[c\] ? states\[c\] : past_q/sample_forward_4[c] ? past_q : sample_forward_3[c] ? states[c] : next/'
  samples_broken from_outside_the_tile sample_places 's/(inside_x_q\[2+d\]\[g\] ||/(1'"'b1 ||/"
  samples_broken outside_written sample_places 's/valid_i\[6\] \&\& inside_x_q\[6\]\[g\] \&\& /valid_i[6] \&\& /'
  samples_broken another_row sample_places 's/row_q\[2+d\]\[g\*BLK+:BLK\] == row_q\[2\]\[g\*BLK+:BLK\]/1'"'b1/"
fi

# --- what is forwarded out of k5: compositing as in prove_bounds.sh
package_file="$work/composite_samples_pkg.sv"
package EVERY_SAMPLE=1 STATE_BITS=5 TRANS_BITS=5 SHEET_BITS=5 TRANS_FRAC=4 SHIFT_LIGHT=4 SHIFT_ABSORBED=4 FREEZE_BELOW=2 >"$package_file"
specification=composite_lane
composite() { unit "$1" composite_lane "" "" "${2:+composite_lane}" "${2-}"; }
composite composite_samples
holds composite_samples 2 "composite_lane, every sample: the value forwarded out of k5 is the later value of k6; words of 5 bits"
happens composite_samples 10
composite composite_samples_thawed "s/stepped(1'b0, frozen_k5_q, c == 3/stepped(1'b0, 1'b0, c == 3/"
refuted composite_samples_thawed 6

# --- the wait: decode as in prove_control.sh, centres four times as fine as the phases
package_file="$work/decode_samples_pkg.sv"
package EVERY_SAMPLE=1 RLUT_SETS=2 RLUT_COLUMNS=8 COL_BITS=4 PHASES=2 PHASE_LOG2=1 PHASE_BITS=1 SHIFT_SNAP=2 ROUND_SNAP=1 >"$package_file"
specification=stream_decode
places=""
for pair in x_here=x_here y_here=y_here x_last=x_last_q y_last=y_last_q fresh=fresh_q; do
  places="$places connect -nounset -set f_${pair%=*} gen_samples.u_overlap.${pair#*=};"
done
decode() { connects=$places unit "$1" stream_decode "overlap snap" "" "${2:+$2}" "${3-}"; }
decode decode_samples
holds decode_samples 2 "stream_decode, every sample: a record's first window waits a cycle if and only if it shares a pixel with the window just issued"
decode_broken() { defines=-DF_FEW_BEATS decode "decode_samples_$1" "$2" "$3"; refuted "decode_samples_$1" "${4:-8:11}"; }
decode_broken beside overlap "s/ \&\& d\[LOG2-1:0\] != '0//"
if [ -z "$short" ]; then
  happens decode_samples 20
  decode_broken never_left overlap "s/(d\[ORG:LOG2\] == '1 \&\& d\[LOG2-1:0\] != '0/(1'b0/"
  decode_broken before_the_last stream_decode 's/is_splat \&\& window_valid_o \&\& overlap/is_splat \&\& overlap/'
  decode_broken issued_at_once stream_decode "s/assign issues = is_splat \&\& !wait_hazard;/assign issues = is_splat;/"
fi
