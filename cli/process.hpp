// SPDX-License-Identifier: Apache-2.0
// Process-wide setup: closed descriptors, signals, limits.
#pragma once

namespace fastsplat::cli {

/// Call first in main. Occupies standard descriptors that the caller closed, so that no result file can become stdout.
/// Turns a gone reader or a file-size limit into an ordinary write error. Makes Ctrl-C, TERM and HUP remove unfinished
/// files and exit with 128 + signal (130 for Ctrl-C).
void prepare_process();

}  // namespace fastsplat::cli
