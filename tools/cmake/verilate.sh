#!/bin/sh
# verilate.sh LOG COMMAND...: runs a build step, keeping what it prints in LOG; shows it only when the step fails.
log=$1
# SPDX-License-Identifier: Apache-2.0
shift
if "$@" >"$log" 2>&1; then exit 0; fi
cat "$log" >&2
exit 1
