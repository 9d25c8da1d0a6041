// One recorded stream of a small scene for a configuration and its vectors, made once by the program for all tests of a
// run.
#pragma once

#include <string>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::test {

struct Recorded {
  cli_test::TempFolder folder;
  std::string stream, vectors;  ///< scene.fss and the folder
};
const Recorded& recorded();             ///< of tiny
const Recorded& recorded_that_culls();  ///< of configs/faults/cull.toml: sets that the device tells to be hidden, beats
                                        ///< whose last pixel lies outside
inline const char* const kCulling = FASTSPLAT_SOURCE_DIR "/configs/faults/cull.toml";

/// A Python that has `module`; empty for none.
std::string python_with(const std::string& module);

}  // namespace fastsplat::test
