# SPDX-License-Identifier: Apache-2.0
# Shared by the maintainers' tools: each is a script that begins with its help text and sources this file. Provides the
# functions of `run` (packages, build, messages) and those used by several tools.
source "$(dirname -- "${BASH_SOURCE[0]}")/../../run"
tool=${0##*/}
needs+=(rtl tests)

for argument in "$@"; do
  case $argument in -h | --help) sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0 ;; esac
done

# expect_names WHAT "KNOWN..." WHERE NAME...: fails on unknown names. WHERE: file that lists the known ones, if they are too many for a line
expect_names() {
  local what=$1 known=$2 where=$3 name
  shift 3
  for name in "$@"; do
    [[ " $known " == *" $name "* ]] || fail "$what '$name'; expected one of ${where:-$known}" 2
  done
}

expect_benchmark_flags() {
  local argument
  for argument in "${@:2}"; do
    [[ $argument == --benchmark_* ]] || fail "$1: expected flags of Google Benchmark such as --benchmark_filter=REGEX, got '$argument'" 2
  done
}

# benchmark NAME [FLAGS]: runs repetitions, randomly interleaved, and keeps the JSON.
benchmark() {
  local name="$1"
  shift
  "$build/bin/$name" --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true --benchmark_min_time=0.1 \
    --benchmark_out="$build/$name.json" --benchmark_out_format=json "$@" >&2
}

# page NAME JSON...: generates docs/NAME.md.
page() {
  local name="$1"
  shift
  "$build/bin/fastsplat_${name}_table" "$@" >"$build/$name.md"
  mv -- "$build/$name.md" "$root/docs/$name.md"
  say "docs/$name.md; figures from $*"
}

# keep_evidence FILE NAME: adds the date and the hashes of the RTL, and moves it to docs/evidence/NAME.json.
keep_evidence() {
  python3 -B "$root/tools/helpers/evidence_stamp.py" "$root" "$1"
  mv -- "$1" "$root/docs/evidence/$2.json"
}

# keep_figures NAME TOOL PROGRAM [TESTS]: runs (these tests of) the test program and keeps its figures as docs/evidence/NAME.json.
keep_figures() {
  mkdir -p "$build/evidence"
  "$build/bin/$3" --gtest_filter="${4:-*}" --gtest_output="json:$build/evidence/$1.json" >&2 || fail "$3 failed"
  "$build/bin/fastsplat_evidence" figures "$2" "$build/evidence/$1.json" >"$build/evidence/$1.new" || fail "$1: the tests printed no figures"
  keep_evidence "$build/evidence/$1.new" "$1"
}

evidence_page() {
  python3 -B "$root/tools/helpers/evidence_stamp.py" "$root" >"$build/evidence/now.json"
  "$build/bin/fastsplat_evidence" page "$root/docs/evidence" "$build/evidence/now.json" >"$build/evidence/evidence.md"
  mv -- "$build/evidence/evidence.md" "$root/docs/evidence.md"
  say "docs/evidence.md, from docs/evidence/*.json"
}
