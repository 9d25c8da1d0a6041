// One recorded stream of a small scene for tiny and its vectors, made once by the program for all tests of a run.
#pragma once

#include <string>

#include "tests/cli/process_helper.hpp"

namespace fastsplat::test {

struct Recorded {
  cli_test::TempFolder folder;
  std::string stream, vectors;  ///< scene.fss and the folder
};
const Recorded& recorded();

/// A Python that has `module`; empty for none.
std::string python_with(const std::string& module);

}  // namespace fastsplat::test
