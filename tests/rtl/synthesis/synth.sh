#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# synth.sh FAMILY CONFIG EMIT_PACKAGE SOURCE_DIR WORK_DIR: synthesis of the device by Yosys and, for iCE40, placement by nextpnr.
# Writes to WORK_DIR the files that fastsplat_evidence reads:
#   FAMILY-CONFIG.stat    cells by module (`stat`), hierarchy kept
#   FAMILY-CONFIG.levels  longest path of each module between registers, memories and its submodules (`ltp`)
#   FAMILY-CONFIG.tools   versions, one a line, the configuration's hash, and the processor seconds of synthesis
#   FAMILY-CONFIG.report, .place   placed (FAMILY hx8k only): nextpnr's report and its log
#   FAMILY-CONFIG.bin     the bitstream of a whole device, if icepack is installed
# FAMILY: ice40, xc7, ecp5; hx8k: flattened, mapped by delay (abc9) and placed. tiny stands for tiny_hx8k.toml in ice40_wrap;
# other configurations are placed whole in ice40_whole. CONFIG plain, ellipses, samples, densities, cull_block, cull_pixel:
# configs/faults/westover.toml without these keys, or with that key alone, to show its cost. CONFIG sample_*: WORK_DIR/FAMILY-CONFIG.toml. SEEDS: seeds of the placer (1 to 8).
set -eu
family=$1 config=$2 emit=$3 source=$4 work=$5
mkdir -p "$work"
here="$source/tests/rtl/synthesis"
base="$work/$family-$config"
top=fastsplat_core files= place=
case $family in
  ice40) pass="synth_ice40 -noflatten -top $top" ;;
  xc7) pass="synth_xilinx -family xc7 -noiopad -noclkbuf -top $top" ;;
  ecp5) pass="synth_ecp5 -noflatten -top $top" ;;
  hx8k)
    command -v nextpnr-ice40 >/dev/null || { echo "skipped: nextpnr-ice40 is not installed (optional package nextpnr-ice40)"; exit 77; }
    place=1
    if [ "$config" = tiny ]; then top=ice40_wrap; else top=ice40_whole; fi
    files="$here/$top.sv"
    pass="synth_ice40 -abc9 -device hx -top $top -json $base.json" ;;
  *) echo "synth.sh: no family $family" >&2; exit 2 ;;
esac

if [ "$top" = ice40_wrap ]; then
  "$emit" "$here/tiny_hx8k.toml" | sed -e 's/\(localparam int \(STATE_BITS\|TRANS_BITS\|SHEET_BITS\)\) = 5;/\1 = 4;/' \
    -e 's/\(localparam int TRANS_FRAC\) = 4;/\1 = 3;/' >"$base.pkg.sv"
else
  from=$config
  case $config in
    sample_*) from="$base.toml" ;;
    plain | ellipses | samples | densities | cull_block | cull_pixel)
      from="$base.toml"
      sed -e '/^\[ellipse\]/,/^$/d' -e '/^every_sample/d' "$source/configs/faults/westover.toml" >"$from"
      case $config in
        ellipses) sed -n '/^\[ellipse\]/,/^$/p' "$source/configs/faults/westover.toml" >>"$from" ;;
        samples) sed -i 's/^freeze_below = .*/&\nevery_sample = 1/' "$from" ;;
        densities) printf '\n[classify]\nsegment_bits = 4\n' >>"$from" ;;
        cull_*) printf '\n[cull]\nmap = "%s"\n' "${config#cull_}" >>"$from" ;;
      esac ;;
  esac
  "$emit" "$from" >"$base.pkg.sv"
fi

# Cells are mapped and placed by their names, which contain file names and running numbers. Figures must change with the
# device alone, so its modules are read from one folder, without other modules, and deferred (only the ones in use).
rm -rf "$base.rtl"
mkdir "$base.rtl"
for file in "$source"/rtl/*.sv "$source"/rtl/*/*.sv; do
  case $file in */rtl/io/*) ;; *) cp "$file" "$base.rtl" ;; esac
done
modules=$(sed -n 's/^module \([a-z0-9_]*\).*/\1/p' "$base.rtl"/*.sv)

# What ends a path: registers, memories, submodules.
ends="t:FD* t:SRL* t:RAM* t:TRELLIS_FF t:TRELLIS_DPR* t:DP16KD t:SB_DFF* t:SB_RAM* t:*fastsplat_ram_1r1w"
for module in $modules; do ends="$ends t:$module"; done

yosys -q -l "$base.log" -p "read_verilog -defer -sv -I$source/rtl $base.pkg.sv $base.rtl/*.sv $files; hierarchy -check -top $top; $pass; tee -o $base.stat.new stat; delete $ends; tee -o $base.levels ltp -noff" >/dev/null 2>&1 ||
  { tail -5 "$base.log"; echo "$family $config: Yosys fails"; exit 1; }
{
  sed -n 's/^\(Yosys [^ ]*\) .*/yosys \1/p' "$base.log" | tail -1
  # The configuration's hash, where the device is one as it is.
  hex() { sed -n "s/.* HASH_$1 = 32'h\([0-9a-f]*\);.*/\1/p" "$base.pkg.sv"; }
  [ "$top" = ice40_wrap ] || echo "configuration $(hex HIGH)$(hex LOW)"
  sed -n 's/.*CPU: user \([0-9.]*\)s.*/seconds \1/p' "$base.log" | tail -1
} >"$base.tools"

if [ -n "$place" ]; then
  # Router and placer are seeded: the same netlist and seed give the same placement. In a nearly full device the seed decides, so several
  # are placed, all are reported, and the fastest is kept.
  best=0
  for seed in ${SEEDS:-1 2 3 4 5 6 7 8}; do
    nextpnr-ice40 --hx8k --package ct256 --json "$base.json" --seed "$seed" --freq 80 --pcf-allow-unconstrained --timing-allow-fail \
      --detailed-timing-report --asc "$base.asc.new" --report "$base.report.new" --log "$base.place.new" -q >/dev/null 2>&1 ||
      { tail -5 "$base.place.new"; echo "$family $config: nextpnr fails"; exit 1; }
    # Both in kHz; the last of the lines is the placed and routed one.
    speed=$(sed -n 's/.*Max frequency for clock.*: \([0-9]*\)\.\([0-9][0-9]\) MHz.*/\1\20/p' "$base.place.new" | tail -1)
    echo "seed $seed $speed" >>"$base.tools"
    if [ "$speed" -gt "$best" ]; then
      best=$speed
      for what in asc report place; do mv -- "$base.$what.new" "$base.$what"; done
    fi
  done
  rm -f -- "$base.asc.new" "$base.report.new" "$base.place.new"
  nextpnr-ice40 --version 2>&1 | sed -n 's/.*Version \([^)]*\)).*/nextpnr nextpnr-ice40 \1/p' >>"$base.tools"
  if [ "$top" = ice40_whole ] && command -v icepack >/dev/null; then
    icepack "$base.asc" "$base.bin"
    echo "bitstream $(wc -c <"$base.bin")" >>"$base.tools"
  fi
fi
mv -- "$base.stat.new" "$base.stat"
