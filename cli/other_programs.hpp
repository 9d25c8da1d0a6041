// The programs of others that this one or its tests call: whether they are there, which version, how to get them.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace fastsplat::cli {

struct OtherProgram {
  std::string name;          ///< what it is known by
  std::string use;           ///< what goes without it
  std::string get;           ///< a command
  std::string path;          ///< empty: not found
  std::string version = {};  ///< as it says itself; empty where it does not
  std::string problem = {};  ///< why it is of no use though it is there, one line
  bool usable() const { return !path.empty() && problem.empty(); }
};

/// Looks for each on the PATH and runs those it finds, all at once, to ask for their versions. One that has not
/// answered within `limit` is ended, with what it has started.
std::vector<OtherProgram> look_for_programs(std::chrono::milliseconds limit = std::chrono::seconds(5));

}  // namespace fastsplat::cli
