// SPDX-License-Identifier: Apache-2.0
// Line and branch coverage of rtl/, and its cover points, as Verilator writes them (--coverage-line --coverage-user).
// Read here rather than by verilator_coverage, which in version 5.006 shows line counts doubled.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fastsplat::testbench {

/// Line coverage that is excused (docs/coverage_exclusions.toml).
struct LineExclusion {
  std::string file;  ///< in rtl/
  std::string line;  ///< its text, without indentation
  std::string kind;  ///< `line`, `if`, `else`, `case`; as LinePoint::kind
  std::string reason;
};

/// A place of the source that is either reached or not.
struct LinePoint {
  std::string file;  ///< name, without folder
  int line = 0, column = 0;
  /// `line`: a block; `if` and `else`: the two ways of a condition (an else that is not written counts as well);
  /// `case`: an arm.
  std::string kind;
  std::vector<int> lines;  ///< that run when it is reached
  std::uint64_t hits = 0;  ///< over all instances
};

class LineCoverage {
 public:
  /// Adds a coverage.dat. Points of the same place add up over instances, runs and configurations.
  void add(const std::string& dat);
  void merge(const LineCoverage& other);

  std::vector<LinePoint> points() const;                                              ///< by file, line, column
  const std::map<std::string, std::uint64_t>& cover_points() const { return user_; }  ///< name -> hits

 private:
  std::map<std::string, LinePoint> points_;  ///< by place
  std::map<std::string, std::uint64_t> user_;
};

struct LineFinding {
  LinePoint point;
  std::string text;    ///< of its line
  std::string reason;  ///< why it is excused; empty: not excused
};

struct LineClosure {
  std::vector<LinePoint> points;
  std::vector<LineFinding> unreached;  ///< excused or not
  std::vector<std::string> findings;   ///< failures: unexcused points, exclusions that are hit or match nothing
  std::map<std::string, std::vector<std::string>> sources;  ///< file -> its lines
};

/// The files below a folder, by name; no two have the same name.
std::map<std::string, std::filesystem::path> sources_in(const std::filesystem::path& folder);

/// Reads the sources from the folder `rtl` and its sub-folders.
LineClosure close_lines(const LineCoverage& coverage, const std::filesystem::path& rtl,
                        const std::vector<LineExclusion>& exclusions);

}  // namespace fastsplat::testbench
