#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# ratchet.sh FAMILY CONFIG EMIT_PACKAGE SOURCE_DIR WORK_DIR EVIDENCE: synthesises and compares with the figures kept in
# docs/evidence/synthesis.json; more than 2 % away, smaller or greater, is red.
set -eu
# Placed with the seed of the kept figures alone.
SEEDS=$("$6" seed "$4/docs/evidence/synthesis.json" "$1-$2")
export SEEDS
"$4/tests/rtl/synthesis/synth.sh" "$1" "$2" "$3" "$4" "$5"
"$6" ratchet "$4/docs/evidence/synthesis.json" "$5" "$1-$2"
