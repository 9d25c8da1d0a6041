#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Usage: lint_edges.sh EMIT SOURCE_ROOT SCRATCH
# Configurations at the limits of the RTL: Verilator reads each with all warnings on and prints none. (array.lanes = 32
# is clean too, but takes Verilator 100 s.)
set -euo pipefail
emit=$1 root=$2 scratch=$3
mkdir -p "$scratch"
read_count=0

# lint BASE KEY=VALUE...
lint() {
  local base=$1 change table key value toml="$scratch/edge.toml"
  shift
  cp "$root/configs/$base.toml" "$toml"
  for change in "$@"; do
    table=${change%%.*} key=${change#*.} value=${key#*=} key=${key%%=*}
    sed -n "/^\[$table\]/,/^\[/p" "$toml" | grep -q "^$key = " || sed -i "/^\[$table\]/a $key = $value" "$toml"
    sed -i "/^\[$table\]/,/^\[/s/^$key = .*/$key = $value/" "$toml"
    sed -n "/^\[$table\]/,/^\[/p" "$toml" | grep -q "^$key = $value$" || { echo "no key $table.$key in $base"; exit 1; }
  done
  "$emit" "$toml" > "$scratch/fastsplat_pkg.sv"
  if ! verilator --lint-only -Wall --assert --top-module fastsplat_core -I"$root/rtl" "$scratch/fastsplat_pkg.sv" \
      "$root"/rtl/*.sv "$root"/rtl/*/*.sv > "$scratch/log" 2>&1; then
    echo "$base $*:"
    cat "$scratch/log"
    exit 1
  fi
  read_count=$((read_count + 1))
}

lint tiny tile.width=16
lint tiny tile.height=16
lint tiny tile.width=4 tile.height=36
lint tiny tile.width=2 tile.height=8
lint tiny tile.width=2 tile.height=2
lint tiny composite.freeze_below=0
lint tiny sheet.frac_bits=31
lint tiny rlut.sets=64
lint tiny radial.entries=2 opacity.segments=2
lint tiny pixel.int_bits=8 pixel.frac_bits=24
lint tiny position.int_bits=11 position.frac_bits=12
lint tiny position.int_bits=16 position.frac_bits=12
lint base tile.width=512
lint hx8k composite.lanes=2 counters.bits=33
lint hx8k composite.lanes=4 counters.bits=64
lint faults/westover tile.width=2 tile.height=2 ellipse.frac_bits=0
lint faults/westover array.lanes=4 composite.freeze_below=0
lint faults/westover colour.int_bits=4 colour.frac_bits=12 pixel.int_bits=4
lint faults/westover colour.int_bits=1 colour.frac_bits=2 sheet.int_bits=1 composite.frac_bits=4 composite.freeze_below=0
lint faults/post radial.entries=2 rlut.guard_bits=1 ellipse.frac_bits=0
lint faults/post array.lanes=4 radial.int_bits=0 ellipse.frac_bits=0 composite.lanes=16
lint faults/post tile.width=4 tile.height=36 classify.segment_bits=10
lint faults/post sheet.int_bits=7 sheet.frac_bits=4 classify.segment_bits=1 composite.lanes=1 radial.interpolate=0
for map in '"block"' '"pixel"'; do
  lint faults/cull cull.map="$map"
  lint faults/cull cull.map="$map" tile.width=2 tile.height=2
  lint faults/cull cull.map="$map" ellipse.frac_bits=0
  lint faults/cull cull.map="$map" tile.width=4 tile.height=36
  lint faults/cull cull.map="$map" tile.width=32 tile.height=2
  lint faults/cull cull.map="$map" array.lanes=4 rlut.columns=4 composite.lanes=16 composite.freeze_below=0
done
echo "[figure] configurations at the ends of the limits, without a warning = $read_count"
(( read_count == 35 ))
