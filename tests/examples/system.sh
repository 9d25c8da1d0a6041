#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# system.sh SYSTEM FASTSPLAT WORK_DIR: the example system renders a recorded stream as the model does, reports a refused
# beat and continues after it, and refuses impossible requests.
set -eu
system=$1 fastsplat=$2 work=$3
page=$(cd "$(dirname "$0")/../../docs" && pwd)/integration.md
rm -rf "$work"
mkdir -p "$work"
cd "$work"
fail() { echo "system.sh: $*" >&2; exit 1; }

"$fastsplat" stream record --volume shells:16 --config small --size 96 -o shells.fss >record.log 2>&1 || { cat record.log; fail "no stream"; }
"$system" shells.fss shells.png >plain.log || { cat plain.log; fail "the picture differs"; }
cat plain.log
grep -q 'picture: 36864 words, 0 differ' plain.log || fail "not a whole picture compared"
grep -q 'counters: 16 read, 0 differ' plain.log || fail "not all counters compared"
[ -s shells.png ] || fail "no picture"
grep -q 'a write of one byte: SLVERR, IRQ_MASK 0x0' plain.log || fail "half a write is taken"

"$system" shells.fss again.png --break >broken.log || { cat broken.log; fail "no recovery"; }
cat broken.log
sed -n '/^\$ build.bin.fastsplat_system shells.fss again.png --break/,/^```/p' "$page" | sed '1d;$d' | diff - broken.log || fail "docs/integration.md shows another log"
grep -q 'ERROR rule 3 opcode 0x73' broken.log || fail "the refusal is not told"
spoiled=$(sed -n 's/.* beat \([0-9]*\) (spoiled: \([0-9]*\)).*/\1 \2/p' broken.log)
[ "${spoiled% *}" = "${spoiled#* }" ] || fail "another beat is told: $spoiled"
grep -q 'marked as cut short: 1' broken.log || fail "no tile was marked"
cmp shells.png again.png || fail "another picture after the refusal"

"$fastsplat" stream record --volume shells:16 --config tiny --size 32 -o tiny.fss >record.log 2>&1
if "$system" tiny.fss tiny.png 2>error.log; then fail "took a stream of another configuration"; else [ $? -eq 3 ] || fail "another exit code than 3"; fi
grep -q 'another configuration' error.log || { cat error.log; fail "no reason told"; }
# Reported before the simulation starts; nothing is lost.
cp shells.fss shells.copy
refused() { # EXIT WORDS ARGS...
  expected=$1 words=$2 status=0
  shift 2
  "$system" "$@" >refused.log 2>error.log || status=$?
  [ $status -eq "$expected" ] && [ ! -s refused.log ] && grep -q "$words" error.log || { cat refused.log error.log; fail "$*: exit code $status, expected $expected and '$words'"; }
}
refused 2 'the output would replace the input' shells.fss ./shells.fss
refused 3 'does not exist' shells.fss nowhere/shells.png
refused 2 'unsupported picture format' shells.fss shells.xyz
refused 2 'unknown flag' --help
refused 3 'none.fss' none.fss none.png
cmp shells.fss shells.copy || fail "the stream is another now"
"$system" --break shells.fss third.png >third.log && grep -q "marked as cut short: 1" third.log && cmp shells.png third.png || fail "--break in front is another thing"
if "$system" 2>error.log; then fail "took nothing"; else [ $? -eq 2 ] || fail "another exit code than 2"; fi
echo "[figure] systems' pictures equal to the model's = 3, refusals told = 8"
