// SPDX-License-Identifier: Apache-2.0
// External programs that fastsplat or its tests call: whether they are installed, their versions, how to get them.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace fastsplat::cli {

struct OtherProgram {
  std::string name;          ///< common name
  std::string use;           ///< what requires it
  std::string get;           ///< command that installs it
  std::string path;          ///< empty: not found
  std::string version = {};  ///< as it reports itself; empty if it does not
  std::string problem = {};  ///< why it cannot be used although installed, one line
  bool usable() const { return !path.empty() && problem.empty(); }
};

/// Searches the PATH for each and runs all that it finds in parallel for their versions. A program that does not answer
/// within `limit` is killed, with its children.
std::vector<OtherProgram> look_for_programs(std::chrono::milliseconds limit = std::chrono::seconds(5));

}  // namespace fastsplat::cli
