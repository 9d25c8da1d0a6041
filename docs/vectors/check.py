#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares a device's transcript with a conformance vector (docs/stream.md, "Vectors").

usage: check.py VECTOR TRANSCRIPT
Prints PASS and what was compared (exit code 0), or FAIL and the first difference (1).
"""
import sys
from collections import Counter

KINDS = ("pixel", "counter", "refused")


def expected_of(path):
    """Lines of the kinds above: what the device must print, in this order."""
    with open(path, encoding="utf-8") as file:
        lines = [line.split("#")[0].split() for line in file]
    return [line for line in lines if line and line[0] in KINDS]


if len(sys.argv) != 3:
    sys.exit(__doc__)
vector, transcript = sys.argv[1:]
expected, got = expected_of(vector), expected_of(transcript)
for number, (want, have) in enumerate(zip(expected + [["nothing"]], got + [["nothing"]])):
    if want != have:
        sys.exit(f"FAIL {vector}: line {number} of the transcript is '{' '.join(have)}', not '{' '.join(want)}'")
counts = Counter(line[0] for line in expected)
if not expected:
    sys.exit(f"FAIL {vector}: nothing to compare")
print(f"PASS {vector}: equal are {', '.join(f'{counts[kind]} x {kind}' for kind in KINDS)}")
