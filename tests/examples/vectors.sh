#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# vectors.sh FASTSPLAT EMIT_PACKAGE VECTORS FAULT_PACKAGE SOURCE_DIR WORK_DIR: the model still makes the conformance
# vectors of docs/vectors. The RTL passes them in Icarus; broken RTL and broken transcripts do not.
set -eu
fastsplat=$1 emit=$2 vectors=$3 faults=$4 source=$5 work=$6
command -v iverilog >/dev/null || { echo "skipped: Icarus Verilog is not installed (package iverilog)"; exit 77; }
rm -rf "$work"
mkdir -p "$work/rtl" "$work/new"
cd "$work"
fail() { echo "vectors.sh: $*" >&2; exit 1; }

"$vectors" new
for file in "$source"/docs/vectors/*.txt; do
  cmp "$file" "new/${file##*/}" || fail "made anew they are others: build/bin/fastsplat_vectors docs/vectors"
done
[ "$(ls new)" = "$(cd "$source/docs/vectors" && ls -- *.txt)" ] || fail "docs/vectors has other files than are made"

# Icarus 11 gives all always_comb blocks one event; as always @* they wait for what they read.
for file in "$source"/rtl/*.sv "$source"/rtl/*/*.sv "$source"/rtl/*.svh; do
  sed 's/always_comb/always @*/' "$file" >"rtl/${file##*/}"
done
# play NAME [OPTION...]: writes NAME.transcript
play() {
  name=$1
  shift
  iverilog -g2012 "$@" -o "$name.vvp" -Irtl -s bench "$faults" "$name.sv" rtl/*.sv "$source/docs/vectors/bench.sv" >iverilog.log 2>&1 || { cat iverilog.log; fail "$name does not compile"; }
  timeout 300 vvp -n "$name.vvp" "+vector=new/$name.txt" >"$name.transcript"
}
check() { python3 -B "$source/docs/vectors/check.py" "$@"; }
passed=0
for file in new/*.txt; do
  name=$(basename "$file" .txt)
  sed -n 's/^set /--set /p' "$file" | xargs "$fastsplat" config show tiny >"$name.toml"
  "$emit" "$name.toml" >"$name.sv"
  play "$name"
  check "$file" "$name.transcript" || fail "$name: the RTL does not pass"
  passed=$((passed + 1))
done

cp exponential.transcript good
sed '$d' good >cut
{ cat good; echo "pixel 1 1 0"; } >longer
sed '0,/^counter 16 .*/s//counter 16 1/' good >cycles
: >empty
refused=0
for transcript in cut longer cycles empty; do
  if check new/exponential.txt "$transcript"; then fail "$transcript: taken"; fi
  refused=$((refused + 1))
done
if check empty empty; then fail "nothing was compared, and passed"; fi
broken=0
while read -r name fault; do
  play "$name" "-DFASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::$fault"
  if check "new/$name.txt" "$name.transcript"; then fail "$fault is not seen"; fi
  broken=$((broken + 1))
done <<EOF
exponential ROUND_TRN
exponential SWAPPED_AXES
slices STALE_SLICE
ellipses ELLIPSE_ROW
samples SAMPLE_ROW
culled_blocks CULL_NEWER_MAP
densities POST_HALO
EOF
echo "[figure] vectors passed by the RTL = $passed, broken devices found = $broken, broken transcripts refused = $refused"
