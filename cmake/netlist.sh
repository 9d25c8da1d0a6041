#!/bin/sh
# netlist.sh KIND RTL_DIR PACKAGE OUT [NET]: the device as Yosys understands it, as one Verilog module with the same ports.
#   rtl    read, elaborated, flattened, optimised; memories stay memories
#   ice40  mapped to iCE40 cells, with Yosys' own models of them behind
# NET (of kind rtl) is tied to 0: a netlist that is wrong.
set -eu
kind=$1 rtl=$2 package=$3 out=$4 net=${5-}
log=$out.log
case $kind in
  rtl) passes="proc; flatten; opt; memory -nomap; opt_clean" ;;
  ice40) passes="synth_ice40 -noflatten -top fastsplat_core" ;;
  *) echo "netlist.sh: unknown kind $kind (rtl, ice40)" >&2; exit 2 ;;
esac
yosys -q -l "$log" -p "read_verilog -sv -I$rtl $package $rtl/*.sv; hierarchy -check -top fastsplat_core; $passes; write_verilog -noattr $out.new" >/dev/null 2>&1 ||
  { tail -20 "$log" >&2; echo "netlist.sh: Yosys fails" >&2; exit 1; }
if [ -n "$net" ]; then
  # A net is assigned once, as a whole.
  awk -v net="\\$net" '$1 == "assign" && $2 == net { print "  assign " net " = 1'"'"'b0;"; ++cut; next } { print }
       END { if (cut != 1) { print "netlist.sh: " net " is assigned " cut + 0 " times" >"/dev/stderr"; exit 1 } }' "$out.new" >"$out.cut"
  mv -- "$out.cut" "$out.new"
fi
if [ "$kind" = ice40 ]; then
  { echo '`define NO_ICE40_DEFAULT_ASSIGNMENTS'; cat "$(dirname "$(command -v yosys)")/../share/yosys/ice40/cells_sim.v"; } >>"$out.new"
fi
mv -- "$out.new" "$out"
