// SPDX-License-Identifier: Apache-2.0
// A recorded stream of a small scene and its vectors, made by the program once in a test run.
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
/// Of configs/faults/cull.toml: the device hides some of its sets, and the last pixels of some beats lie outside.
const Recorded& recorded_that_culls();
inline const char* const kCulling = FASTSPLAT_SOURCE_DIR "/configs/faults/cull.toml";

/// A Python that has `module`; empty for none.
std::string python_with(const std::string& module);

}  // namespace fastsplat::test
