#!/bin/sh
# netlist.sh KIND RTL_DIR DUT PACKAGE OUT [NET]: writes fastsplat_top as read by Yosys to one Verilog file, and behind it the
# testbench's wrapper DUT (fastsplat_dut.sv), which finds the taps inside it by their names there.
#   rtl    read, elaborated, flattened, optimised; memories stay memories
#   ice40  mapped to iCE40 cells (hierarchy kept), each cell then replaced by Yosys' own model of it: a LUT's table, a carry,
#          a register; block RAMs stay modules. Registers power up with any value, as in rtl/.
# NET (for kind rtl) is tied to 0, which makes a wrong netlist.
set -eu
# SPDX-License-Identifier: Apache-2.0
kind=$1 rtl=$2 dut=$3 package=$4 out=$5 net=${6-}
log=$out.log
map=$out.map
cells="$(dirname "$(command -v yosys)")/../share/yosys/ice40/cells_sim.v"
# models PATTERN: the models of these modules, without default values of ports and initial values of registers.
models() {
  for value in 0 1 'V(v)'; do printf '`define ICE40_DEFAULT_ASSIGNMENT_%s\n' "$value"; done
  awk -v pattern="^module $1" '/^\(\*/ { next } $0 ~ pattern { on = 1 } /`SB_DFF_INIT/ { next } on { print } /^endmodule/ { on = 0 }' "$cells"
}
case $kind in
  # Nothing in fastsplat_top reads the taps: without `keep` they would go.
  rtl) passes="proc; flatten; setattr -set keep 1 w:u_core.tap_* w:u_core.error_o; opt; memory -nomap; opt_clean" ;;
  ice40)
    {
      printf 'module SB_LUT4 (output O, input I0, I1, I2, I3);\n  parameter [15:0] LUT_INIT = 0;\n'
      printf '  \\$lut #(.WIDTH(4), .LUT(LUT_INIT)) lut (.A({I3, I2, I1, I0}), .Y(O));\nendmodule\n'
      models 'SB_(CARRY|DFF)'
    } >"$map"
    # Splits nets into bits: Verilator would see a carry chain along a vector as a loop.
    passes="synth_ice40 -noflatten -top fastsplat_top; techmap -autoproc -map $map; opt_clean; splitnets; opt_clean" ;;
  *) echo "netlist.sh: unknown kind $kind (rtl, ice40)" >&2; exit 2 ;;
esac
yosys -q -l "$log" -p "read_verilog -sv -I$rtl $package $rtl/*.sv $rtl/*/*.sv; hierarchy -check -top fastsplat_top; $passes; write_verilog -noattr $out.new" >/dev/null 2>&1 ||
  { tail -20 "$log" >&2; echo "netlist.sh: Yosys fails" >&2; exit 1; }
if [ -n "$net" ]; then
  # The net must be assigned exactly once, as a whole.
  awk -v net="\\$net" '$1 == "assign" && $2 == net { print "  assign " net " = 1'"'"'b0;"; ++cut; next } { print }
       END { if (cut != 1) { print "netlist.sh: " net " is assigned " cut + 0 " times" >"/dev/stderr"; exit 1 } }' "$out.new" >"$out.cut"
  mv -- "$out.cut" "$out.new"
fi
if [ "$kind" = ice40 ]; then
  { models 'SB_RAM40_4K \('; cat "$dut"; } >>"$out.new"
else
  sed 's/u_top\.u_core\.\([a-z_]*\)/u_top.\\u_core.\1 /g' "$dut" >>"$out.new"  # one flat module: a name with a dot in it
fi
mv -- "$out.new" "$out"
