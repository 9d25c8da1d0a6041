// SPDX-License-Identifier: Apache-2.0
// Parses a failed assertion from the simulator's output.
#pragma once

#include <string>

namespace fastsplat::testbench {

/// A failed assertion as the simulator words it: "%Error: FILE:LINE: Assertion failed in PATH.NAME: NAME".
struct FailedAssertion {
  std::string name;   ///< empty if there was none
  std::string path;   ///< of the instance
  std::string place;  ///< FILE:LINE
};
FailedAssertion first_failed_assertion(const std::string& output);

}  // namespace fastsplat::testbench
