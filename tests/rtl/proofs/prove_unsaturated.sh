#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# prove_unsaturated.sh EMIT_PACKAGE SOURCE_DIR WORK_DIR: no site whose derived range fits its word (docs/errors.md,
# section 4) can saturate in the RTL of tiny, small and base, for any registers, tables and inputs in the ports' ranges.
# Proved with Yosys and z3 at the configurations' own widths; planted faults are noticed. Where a module keeps a site's
# overflow flag, the flag is proved to be 0. Where it drops the flag, the narrowing of the same operands has none.
# Leaves WORK_DIR/proofs.txt: PROPERTY | HOW | SECONDS | FAULTS REFUTED, one a line.
set -eu
emit=$1 source=$2 work=$3
. "$source/tests/rtl/proofs/common.sh"

# smt NAME CONFIG MODULE [EDIT]: NAME.smt2 of MODULE with the specification of stdin at its end; EDIT breaks a line of
# the module. Memories have free outputs.
smt() {
  cat >"$work/specification.svh"
  if passed_over "$1"; then return; fi
  name=$1 module=$3 edit=${4-}
  "$emit" "$source/configs/$2.toml" >"$work/$2.sv"
  with_spec "$module" "$work/specification.svh" >"$work/$name.sv"
  [ -z "$edit" ] || broken "$work/$name.sv" "$edit"
  # assertions.svh is read without -formal first, so the module's own assertions vanish: its other proofs have them.
  yosys -q -l "$work/$name.log" -p "read_verilog -sv -I$source/rtl $source/rtl/assertions.svh $work/$2.sv $(file_of ram_1r1w); read_verilog -sv -formal -I$source/rtl $work/$name.sv; hierarchy -check -top $(rtl_of "$module"); proc; cutpoint t:fastsplat_ram_1r1w t:*\\fastsplat_ram_1r1w; flatten; opt -full; async2sync; dffunmap; opt_clean; check -assert; write_smt2 -wires $work/$name.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$name.log"; echo "$name: Yosys fails"; exit 1; }
  grep -q 'yosys-smt2-assert' "$work/$name.smt2" || { echo "$name: nothing to prove"; exit 1; }
}

# --- snap: where phases are as fine as positions no centre is rounded
snap() {
  smt "$1" "$2" snap "${3-}" <<'END'
always @* assert (!overflow);
END
}

# --- product: any colour times any weight; the counter's own flag
product() {
  smt "$1" "$2" lane "${3-}" <<'END'
logic f_known = 1'b0;
always @(posedge clk_i) begin
  f_known <= f_known || valid_i[LAST];
  if (f_known) assert (saturated_o == '0);
end
END
}

# --- fall: segments that the stream may load (S-table-7). The second assertion: these are the module's own operands.
fall() {
  smt "$1" "$2" slab_opacity "${3-}" <<'END'
logic [FB-1:0] f_start, f_fall, f_factor_q;
logic [FB:0] f_narrowed;
logic f_known = 1'b0;
assign {f_start, f_fall} = segment_k2;
assign f_narrowed = narrow_fall((FB + REM)'(f_fall) * (FB + REM)'(remainder_k2_q));
always @* assume (f_start <= FB'(1) << (FB - 1) && f_fall <= f_start);
always @* assert (!f_narrowed[FB]);
always @(posedge clk_i) begin
  f_known <= valid_i[2];
  f_factor_q <= f_start - f_narrowed[FB-1:0];
  if (f_known) assert (factor_k3_q == f_factor_q);
end
END
}

# --- light and absorbed: transmittance and slab of One.tf, as prove_bounds.sh has them
light() {
  smt "$1" "$2" composite_lane "${3-}" <<'END'
localparam logic [TB-1:0] F_ONE = TB'(1) << fastsplat_pkg::TRANS_FRAC;
logic f_known = 1'b0;
always @(posedge clk_i) f_known <= valid_i[4] && !sum_mode;
always @* assume (transmittance <= F_ONE);
for (genvar c = 0; c < 4; c++) begin : gen_f
  logic [TB-1:0] f_slab;
  logic [TB:0] f_narrowed;
  logic [DB-1:0] f_light_q;
  assign f_slab = slab_i[c*DB+:TB];
  assign f_narrowed = (c == 3) ? narrow_absorbed((2 * TB)'(transmittance) * (2 * TB)'(f_slab)) :
                                 narrow_light((2 * TB)'(transmittance) * (2 * TB)'(f_slab));
  always @* assume (f_slab <= F_ONE);
  always @* assert (!f_narrowed[TB]);
  always @(posedge clk_i) begin
    f_light_q <= DB'(f_narrowed[TB-1:0]);
    if (f_known) assert (gen_channel[c].light_k5_q == f_light_q);
  end
end
END
}

# --- pixel out of composited pixels: any state
pixel() {
  smt "$1" "$2" pixel_out "${3-}" <<'END'
logic f_known = 1'b0;
always @(posedge clk_i) if (enable && valid_r1_q) f_known <= mode_i != 2'd2;
for (genvar n = 0; n < 4 * P; n++) begin : gen_f
  always @* if (f_known) assert (!gen_pixel[n / 4].gen_channel[n % 4].pixel_q[PB]);
end
END
}

# prove SITE SUBJECT CONFIG...: "CONFIG: SUBJECT".
prove() {
  site=$1 subject=$2
  shift 2
  for config; do
    $site "${site}_$config" "$config"
    holds "${site}_$config" 2 "$config: $subject"
  done
}
# broken_small SITE FAULT EDIT: a fault planted in small, of the property proved last.
broken_small() {
  "$1" "$1_small_$2" small "$3"
  refuted "$1_small_$2" 3
}
# docs/errors.md has base's sites; derived_ranges_test.cpp compares this list with those of all three.
prove snap "centres never saturate" base tiny small
broken_small snap largest_is_above 's/rounded > LARGEST/rounded >= LARGEST/'
prove product "products never saturate" base tiny small
broken_small product not_shifted 's/SB, PRODUCT)/SB, SUM)/'
prove fall "the slab factor's fall never saturates" base tiny small
broken_small fall not_shifted 's/FB, FALL)/FB, SUM)/'
broken_small fall of_the_start 's/segment_k2\[FB-1:0\]) \*/segment_k2[2*FB-1:FB]) */'
prove light "light and absorbed light never saturate" base tiny small
broken_small light not_shifted 's/TB, LIGHT)/TB, OVER)/'
broken_small light absorbed_not_shifted 's/TB, ABSORBED)/TB, OVER)/'
broken_small light of_the_state 's/narrow_light((2 \* TB).(transmittance)/narrow_light((2 * TB)'"'"'(state_i[c*DB+:TB])/'
prove pixel "composited pixels never saturate" base small
broken_small pixel one_at_most 's/TB, PB, PIXEL_OUT)/TB, PB, ADDED_COLOUR)/'
