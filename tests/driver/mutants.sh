#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Breaks the driver in each way of mutants.txt, builds it and expects the oracle (DriverOracle*, DriverFamily*, EllipseSets*) red: about ten seconds a
# fault, and not part of ./run test. The sources are edited in place and put back. `mutants.sh WORD` takes those whose
# name has the word. Exit code 1 where one lives, or its text is not there exactly once.
set -euo pipefail

root="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)"
cd "$root"
git diff --quiet HEAD -- driver scene || { echo "mutants: driver/ or scene/ has changes of yours" >&2; exit 2; }
trap 'git checkout -q HEAD -- driver scene' EXIT

killed=0 lived=0
while IFS= read -r line; do
  [[ -z $line || $line == '#'* ]] && continue
  name="${line%% @ *}" rest="${line#* @ }"
  [[ $name == *"${1:-}"* ]] || continue
  file="${rest%% @ *}" rest="${rest#* @ }"
  old="${rest%% @*}" new="${rest#* @}" new="${new# }"
  text="$(cat "$file")"
  without="${text/"$old"/}"
  verdict=""
  if [[ $without == "$text" || $without == *"$old"* ]]; then
    verdict="LIVES: its text is not there exactly once"
  else
    printf '%s\n' "${text/"$old"/"$new"}" >"$file"
    if ! ./run build test_driver_fast >build/mutant.log 2>&1; then
      verdict="LIVES: it does not build (build/mutant.log)"
    elif timeout 300 build/bin/test_driver_fast --gtest_filter='DriverOracle*:*DriverFamily*:FamilyTables*:EllipseSets*' >build/mutant.log 2>&1; then
      verdict="LIVES"
    fi
    git checkout -q HEAD -- "$file"
  fi
  if [[ -n $verdict ]]; then
    lived=$((lived + 1))
  else
    killed=$((killed + 1))
    verdict="killed by $(sed -n 's/^\[  FAILED  \] \(DriverOracle\.\|Kinds\/DriverFamily\.\|FamilyTables\.\|EllipseSets\.\)\([A-Za-z_/]*\).* (.*/\2/p' build/mutant.log | paste -sd' ')"
  fi
  printf '%-45s %s\n' "$name" "$verdict"
done <tests/driver/mutants.txt
./run build test_driver_fast >build/mutant.log 2>&1
echo "[figure] mutants killed = $killed, living = $lived (limit 0)"
(( killed > 0 && lived == 0 ))
