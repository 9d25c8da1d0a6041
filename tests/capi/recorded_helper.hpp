// SPDX-License-Identifier: Apache-2.0
// A recorded stream of a small scene and its vectors; the program makes them once per test run.
#pragma once

#include <string>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::test {

struct Recorded {
  cli_test::TempFolder folder;
  std::string stream, vectors;  ///< scene.fss and the folder
};
const Recorded& recorded();  ///< of tiny
/// For configs/faults/cull.toml: the device hides some of its groups, and the last pixels of some beats lie outside.
const Recorded& recorded_that_culls();
inline const char* const kCulling = FASTSPLAT_SOURCE_DIR "/configs/faults/cull.toml";

/// A Python that has `module`, or an empty text.
std::string python_with(const std::string& module);

}  // namespace fastsplat::test
