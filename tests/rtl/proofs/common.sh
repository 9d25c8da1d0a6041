# SPDX-License-Identifier: Apache-2.0
# common.sh: shared by the proof scripts, which source it with `source` (the repository) and `work` (a folder) set, `emit` if they need the
# package of tiny, and `short` if they accept it. A proof is a module with its specification inside, SMT of it by Yosys, and z3 (yosys-smtbmc).
[ -z "${short-}" ] || [ "$short" = short ] || { echo "$0: not '$short' but short" >&2; exit 2; }
mkdir -p "$work"
here="$source/tests/rtl/proofs"
: >"$work/proofs.txt"
[ -z "${emit-}" ] || "$emit" "$source/configs/tiny.toml" >"$work/tiny.sv"

# FASTSPLAT_PROVE_ONLY=NAME: only the unit NAME; other units (neither NAME nor NAME_...) are skipped.
# passed_over NAME: succeeds if NAME is skipped.
passed_over() {
  case $1 in "${FASTSPLAT_PROVE_ONLY:-$1}" | "${FASTSPLAT_PROVE_ONLY:-$1}"_*) return 1 ;; esac
}
# A script that proved nothing fails.
trap 'status=$?; [ $status -ne 0 ] || [ -s "$work/proofs.txt" ] || { echo "$0: nothing proved${FASTSPLAT_PROVE_ONLY:+, there is no unit $FASTSPLAT_PROVE_ONLY here}"; exit 1; }' EXIT

seconds() { awk -v from="$1" -v to="$(date +%s.%N)" 'BEGIN { printf "%.1f", to - from }'; }

# A unit's module, and its file.
rtl_of() { echo "fastsplat_${1#fastsplat_}"; }
file_of() { find "$source/rtl" -name "$(rtl_of "$1").sv"; }

# with_spec MODULE SPECIFICATION: the module with the text before its end. (z3 does not end on pixel_payload_held, which
# compares all 256 bits; pixel out's specification is stronger.)
with_spec() {
  awk -v spec="$2" '/pixel_payload_held/ { next } /^endmodule/ { while ((getline line < spec) > 0) print line } { print }' "$(file_of "$1")"
}
# broken FILE EDIT: FILE with the sed command EDIT done, which must change it.
broken() {
  sed "$2" "$1" >"$1.edited"
  cmp -s "$1" "$1.edited" && { echo "$1: nothing to break by $2"; exit 1; }
  mv "$1.edited" "$1"
}

# package NAME=VALUE...: the package of tiny, with these values instead.
package() {
  cp "$work/tiny.sv" "$work/package.new"
  for value in "$@"; do
    grep -q "localparam int ${value%=*} =" "$work/package.new" || { echo "package: no ${value%=*}"; exit 1; }
    sed -i "s/\(localparam int ${value%=*}\) = .*;/\1 = ${value#*=};/" "$work/package.new"
  done
  cat "$work/package.new"
}

# unit NAME MODULE BESIDE CUT [FILE EDIT]: NAME.smt2 of MODULE (with its specification inside) and the modules BESIDE
# it. The modules CUT have free outputs, as have $cut_wires. $connects ties undriven names of a specification to
# registers below. EDIT breaks a line of the module FILE. Lines of the specification that contain $without are left out.
unit() {
  if passed_over "$1"; then return; fi
  name=$1 module=$2 beside=$3 cut=$4 file=${5-} edit=${6-}
  free="" read=""
  with_spec "$module" "$here/${specification:-$module}_proof.svh" | grep -v "pixel_beat_not_empty${without:+\\|$without}" >"$work/$name.sv"
  [ "$file" != "$module" ] || broken "$work/$name.sv" "$edit"
  for other in $beside; do
    cp "$(file_of "$other")" "$work/$name.$other.sv"
    [ "$file" != "$other" ] || broken "$work/$name.$other.sv" "$edit"
    read="$read $work/$name.$other.sv"
  done
  quiet=""
  for other in $cut; do
    quiet="$quiet $(file_of "$other")"
    free="$free t:$(rtl_of "$other") t:*\\$(rtl_of "$other")"
  done
  # Check and pixel out are proved by themselves: neither their assertions nor their assumptions are read here.
  for other in stream_check pixel_out; do
    case " $beside " in *" $other "*) quiet="$quiet $work/$name.$other.sv" read=$(echo "$read" | sed "s| [^ ]*\.$other\.sv||") ;; esac
  done
  # Yosys keeps the guard of assertions.svh from one read to the next, and with it the macros as they were without -formal: where modules are cut, those
  # beside have none of their own assertions and assumptions, which is as it should be, for the specification asks for what they assume. The module has.
  yosys -q -l "$work/$name.log" -p "read_verilog -sv -I$source/rtl $package_file $quiet; ${read:+read_verilog -sv -formal ${defines-} -I$source/rtl -I$here $read;} verilog_defines -reset; read_verilog -sv -formal ${defines-} -I$source/rtl -I$here $work/$name.sv; hierarchy -check -top $(rtl_of "$module"); proc; ${free:+cutpoint $free ${cut_wires-};} flatten; ${connects-} delete -output o:*; memory_map; opt -full -purge; async2sync; dffunmap; opt_clean; check -assert; write_smt2 -wires $work/$name.smt2" >/dev/null 2>&1 ||
    { tail -5 "$work/$name.log"; echo "$name: Yosys fails"; exit 1; }
  grep -q 'yosys-smt2-assert' "$work/$name.smt2" || { echo "$name: nothing to prove"; exit 1; }
}

bmc() { # NAME MODE DEPTH
  timeout 900 yosys-smtbmc -s z3 --unroll $2 -t "$3" --noprogress "$work/$1.smt2" >"$work/$1$2.out" 2>&1
}
holds() { # NAME DEPTH PROPERTY: from reset on for DEPTH cycles and, given those, for ever
  if passed_over "$1"; then return; fi
  from=$(date +%s.%N)
  for mode in "" -i; do
    bmc "$1" "$mode" "$2" || { tail -20 "$work/$1$mode.out"; echo "$1: not proved (${mode:-bounded}, $2)"; exit 1; }
  done
  proved "$3" "induction over $2 cycles" "$from"
  echo "[figure] $3: for ever, by induction over $2 cycles, $(seconds "$from") s"
}
proved() { # PROPERTY HOW BEGAN: a line of proofs.txt, of which no planted fault has been refuted yet
  echo "$1 | $2 | $(seconds "$3") | 0" >>"$work/proofs.txt"
}
happens() { # NAME DEPTH: each cover is reached
  if passed_over "$1"; then return; fi
  bmc "$1" -c "$2" || { tail -5 "$work/$1-c.out"; echo "$1: a cover is not reached within $2 cycles"; exit 1; }
  echo "[figure] $1: covers reached = $(grep -c 'Reached cover' "$work/$1-c.out") (limit > 0)"
  grep -q 'Reached cover' "$work/$1-c.out" || exit 1
}
refuted() { # NAME DEPTH, or FROM:DEPTH, which looks at none of the cycles before FROM: one fault more of the property proved last
  if passed_over "$1"; then return; fi
  if bmc "$1" "" "$2"; then echo "$1: the planted fault is not found within $2 cycles"; exit 1; fi
  grep -q 'Assert failed' "$work/$1.out" || { tail -5 "$work/$1.out"; echo "$1: fails for another reason"; exit 1; }
  echo "[figure] planted $1: $(grep -m1 'Assert failed' "$work/$1.out" | sed 's/.*Assert failed in/assertion failed in/')"
  awk -F ' [|] ' -v OFS=' | ' 'NR > 1 { print line } { line = $0; $4 += 1; more = $0 } END { print more }' "$work/proofs.txt" >"$work/proofs.new"
  mv "$work/proofs.new" "$work/proofs.txt"
}
