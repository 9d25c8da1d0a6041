#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_units.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR: each unit against its specification written again (NAME_proof.svh, put inside
# a copy of the module before its end), for ever, by induction, with Yosys and z3; that what is asked about happens; and that each
# proof notices planted faults. Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line.
set -eu
emit=$1 source=$2 work=$3
. "$source/tests/rtl/proofs/common.sh"

# smt NAME MODULE PACKAGE [EDIT]: NAME.smt2 of MODULE with its specification inside; EDIT, a sed command, breaks a line of it.
smt() {
  if passed_over "$1"; then return; fi
  name=$1 module=$2 package=$3 edit=${4-}
  with_spec "$module" "$here/${module}_proof.svh" >"$work/$name.sv"
  [ -z "$edit" ] || broken "$work/$name.sv" "$edit"
  yosys -q -l "$work/$name.log" -p "read_verilog -sv -formal -DFORMAL -I$source/rtl $package $work/$name.sv; hierarchy -check -top $(rtl_of "$module"); proc; flatten; memory_map; opt -full; async2sync; dffunmap; opt_clean; check -assert; write_smt2 -wires $work/$name.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$name.log"; echo "$name: Yosys fails"; exit 1; }
  grep -q 'yosys-smt2-assert' "$work/$name.smt2" || { echo "$name: nothing to prove"; exit 1; }
}

# --- registers
sed 's/\(localparam int COUNTERS\) = .*;/\1 = 2;/' "$work/tiny.sv" >"$work/csr_pkg.sv"
smt csr csr "$work/csr_pkg.sv"
holds csr 3 "csr: every read, write, answer, counter, interrupt and pulse is the page's"
happens csr 12
csr_broken() { smt "csr_$1" csr "$work/csr_pkg.sv" "$2"; refuted "csr_$1" 8; }
csr_broken never_answers "s/rvalid_o <= 1'b1;/rvalid_o <= 1'b0;/"
csr_broken counter_refused "s/if (chosen_q == '0) begin/if (chosen_q != '0) begin/"
csr_broken another_address 's/case (address_q)/case (araddr_i)/'
csr_broken read_survives_reset 's/reading_q <= rst_ni \&\& /reading_q <= /'
csr_broken half_write 's/assign write = awvalid_i && wvalid_i/assign write = (awvalid_i || wvalid_i)/'
csr_broken reset_with_answer "s/^      bvalid_o <= 1'b0;$/      bvalid_o <= 1'b1;/"
csr_broken any_write_clears 's/ && wdata_i\[0\];/;/'
csr_broken high_word_is_the_low 's/high_q <= counter\[63:32\]/high_q <= counter[31:0]/'
csr_broken clear_wins "s/irq_q <= (irq_q & ~(\(.*\))) | {\(.*\)};/irq_q <= (irq_q | {\2}) \& ~(\1);/"
csr_broken refused_for_ever 's/{error_i && !error_q, tile_i/{error_i, tile_i/'
csr_broken mask_unasked "s/irq_o <= (irq_q & irq_mask_q) != '0;/irq_o <= irq_q != '0;/"

# The same with counters of 16 bits, which go round (M-register-11).
sed 's/\(localparam int COUNTER_BITS\) = .*;/\1 = 16;/' "$work/csr_pkg.sv" >"$work/csr_short_pkg.sv"
smt csr_short csr "$work/csr_short_pkg.sv"
holds csr_short 3 "csr: the same where counters have 16 bits and go round"
happens csr_short 12
smt csr_short_one_bit_less csr "$work/csr_short_pkg.sv" 's/64.(counter_q\[n\]);/{49'"'"'d0, counter_q[n][14:0]};/'
refuted csr_short_one_bit_less 8

# --- pixel out: tiles up to 4 x 4 of 2 x 2 lanes, words of a few bits
sed -e 's/\(localparam int \(STATE_BITS\|TRANS_BITS\)\) = .*;/\1 = 3;/' -e 's/\(localparam int SHEET_BITS\) = .*;/\1 = 2;/' \
  -e 's/\(localparam int \(TRANS_FRAC\|PIXEL_BITS\)\) = .*;/\1 = 2;/' -e 's/\(localparam int ADDR_BITS\) = .*;/\1 = 2;/' \
  -e 's/\(localparam int SIDE_BITS\) = .*;/\1 = 4;/' -e 's/\(localparam int \(BLOCKS_X\|BLOCKS_Y\)\) = .*;/\1 = 2;/' \
  -e 's/\(localparam int SHIFT_PIXEL_\(OUT\|SUM\)\) = .*;/\1 = 1;/' \
  -e 's/\(localparam int BLOCKS\) = .*;/\1 = 4;/' -e 's/\(localparam int BLK_BITS\) = .*;/\1 = 1;/' "$work/tiny.sv" >"$work/pixel_pkg.sv"
smt pixel_out pixel_out "$work/pixel_pkg.sv"
holds pixel_out 2 "pixel_out: each pixel once, in order and in time, with its keep, last, words and mark; each row of the picture read once"
happens pixel_out 16
pixel_broken() { smt "pixel_out_$1" pixel_out "$work/pixel_pkg.sv" "$2"; refuted "pixel_out_$1" 12; }
pixel_broken keep_one_more "s/x_r1_q + SIDE'(g) < width_i;/x_r1_q + SIDE'(g) <= width_i;/"
pixel_broken stray_after_reset "/^    if (!rst_ni) begin/,/^    end/s/valid_r1_q <= 1'b0;//"
# M-pixel-4
pixel_broken moves_while_waiting 's/assign enable = !valid_r2_q || ready_i;/assign enable = 1'"'"'b1;/'
pixel_broken last_early "s/y_q + SIDE'(1) >= height_i;/y_q + SIDE'(2) >= height_i;/"
pixel_broken row_read_twice "s/assign picture_re_o = running_q \&\& enable;/assign picture_re_o = running_q || valid_r1_q;/"
pixel_broken mark_of_now "s/last_r2_q <= last_r1_q;/last_r2_q <= last_r1_q; aborted_o <= aborted_i;/"
pixel_broken alpha_upside_down "s/(c == 3) ? (TB'(1) << TF) - word/(c == 3) ? word/"

# --- narrow: every shift from 2 to the left to 6 to the right, every rounding, both kinds of word, more bits lost, kept or added; and
# the widest of the device. The definition (docs/numerics.md, N-1-3 and N-1-4) knows no shift: a word is right by the values next to it.
{
  echo 'package fastsplat_pkg;'
  echo '  localparam int NOTHING = 0;'
  sites=""
  number=0
  for shift in -2 -1 0 1 2 3 4 5 6; do
    for round in 0 1 2; do
      for unit in 0 1; do
        for bits in "7 4" "5 6"; do
          number=$((number + 1))
          echo "  localparam int SHIFT_S$number = $shift, ROUND_S$number = $round, UNIT_S$number = $unit;"
          sites="$sites S$number:${bits% *}:${bits#* }:$shift:$round:$unit"
        done
      done
    done
  done
  for wide in "22 11 10 1 1" "20 11 7 1 0" "24 12 12 2 0" "32 16 16 0 1"; do
    set -- $wide
    number=$((number + 1))
    echo "  localparam int SHIFT_S$number = $3, ROUND_S$number = $4, UNIT_S$number = $5;"
    sites="$sites S$number:$1:$2:$3:$4:$5"
  done
  echo 'endpackage'
  echo '`include "narrow.svh"'
  echo 'module narrow (input logic [31:0] value);'
  for site in $sites; do
    echo "$site" | tr : ' ' | {
      read -r name in out shift round unit
      # Twice the exact value and twice the word, both times 2^right, so that halves are whole.
      right=$((shift > 0 ? shift : 0)) left=$((shift < 0 ? -shift : 0))
      echo "  \`FASTSPLAT_NARROW(narrow_$name, $in, $out, $name)"
      echo "  logic [$out:0] n_$name; logic [47:0] x_$name, w_$name, l_$name;"
      echo "  assign n_$name = narrow_$name(value[$((in - 1)):0]);"
      echo "  assign x_$name = 48'(value[$((in - 1)):0]) * 48'd$((2 << left));"
      echo "  assign w_$name = 48'(n_$name[$((out - 1)):0]) * 48'd$((2 << right));"
      largest=$((unit ? 1 << (out - 1) : (1 << out) - 1))
      echo "  assign l_$name = 48'd$((largest * (2 << right)));"
      one=$((1 << right))  # half a word
      case $round in
        0) near="w_$name <= x_$name && x_$name < w_$name + 48'd$((2 * one))" over="x_$name >= l_$name + 48'd$((2 * one))" ;;
        1) near="w_$name <= x_$name + 48'd$one && x_$name + 48'd$one < w_$name + 48'd$((2 * one))" over="x_$name >= l_$name + 48'd$one" ;;
        # A tie goes to the even one; above an even largest word that is down.
        2) near="w_$name <= x_$name + 48'd$one && x_$name <= w_$name + 48'd$one && (!(w_$name == x_$name + 48'd$one || x_$name == w_$name + 48'd$one) || n_$name[0] == 1'b0)"
           over="x_$name >= l_$name + 48'd$((one + (largest % 2 == 0)))" ;;
      esac
      # Without bits to lose there is no rounding: the word is the value.
      [ "$right" -eq 0 ] && near="w_$name == x_$name" over="x_$name > l_$name"
      echo "  always @* assert (n_$name[$out] == ($over));"
      echo "  always @* assert (n_$name[$out] ? w_$name == l_$name : ($near));"
      # With bits to lose, some are lost.
      [ "$right" -eq 0 ] || echo "  always @* cover (n_$name[$out] == 1'b0 && w_$name != x_$name);"
    }
  done
  echo 'endmodule'
} >"$work/narrow_generated.sv"
narrow() { # NAME [EDIT of narrow.svh]
  if passed_over "$1"; then return; fi
  mkdir -p "$work/$1.include"
  cp "$source"/rtl/*.svh "$work/$1.include"
  if [ -n "${2-}" ]; then
    sed -i "$2" "$work/$1.include/narrow.svh"
    cmp -s "$source/rtl/narrow.svh" "$work/$1.include/narrow.svh" && { echo "$1: nothing to break by $2"; exit 1; }
  fi
  yosys -q -l "$work/$1.log" -p "read_verilog -sv -formal -I$work/$1.include $work/narrow_generated.sv; hierarchy -check -top narrow; proc; flatten; opt_clean; async2sync; dffunmap; check -assert; write_smt2 -wires $work/$1.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$1.log"; echo "$1: Yosys fails"; exit 1; }
}
narrow narrow
if ! passed_over narrow; then
  from=$(date +%s.%N)
  # Nothing is remembered: one step is all.
  bmc narrow "" 1 || { tail -5 "$work/narrow.out"; echo "narrow: not its definition"; exit 1; }
  proved "narrow: word and overflow are their definition, $(grep -c '  localparam int SHIFT_' "$work/narrow_generated.sv") sites" "all inputs" "$from"
  echo "[figure] $(tail -1 "$work/proofs.txt")"
fi
happens narrow 1
narrow_broken() { narrow "narrow_$1" "$2"; refuted "narrow_$1" 1; }
narrow_broken left_is_right 's/<< NAME``_LEFT; /<< NAME``_RIGHT; /'
narrow_broken ties_up 's/NAME``_BIAS + ((wide >> NAME``_RIGHT) & NAME``_EVEN) : NAME``_BIAS;/NAME``_BIAS + NAME``_EVEN : NAME``_BIAS;/'
narrow_broken saturates_late 's/overflow = rounded > NAME``_LARGEST;/overflow = rounded > NAME``_LARGEST + NAME``_ONE;/'
narrow_broken wraps 's/NAME``_LARGEST\[(OUT_BITS)-1:0\] : rounded/rounded[(OUT_BITS)-1:0] : rounded/'
