// How the process meets its surroundings: closed descriptors, signals, limits.
#pragma once

namespace fastsplat::cli {

/// Before anything else in main. Standard descriptors that the caller closed are occupied, so that no result file can
/// become stdout; a gone reader or a file-size limit becomes an ordinary write error; Ctrl-C, TERM and HUP remove
/// unfinished files and end with 128 + signal (130 for Ctrl-C).
void prepare_process();

}  // namespace fastsplat::cli
