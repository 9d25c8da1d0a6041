// Where a failure's files go when nobody named them: a name of which nothing is there, and that no other run has.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/unfinished.hpp"

namespace fastsplat::cli {

/// The first of STEM, STEM-2, STEM-3, ... that is free. It belongs to this run until the object ends, by which time the
/// files are there: runs that fail at the same time in one folder never have the same. UserError (Input) where the
/// folder takes no file.
class FailureName {
 public:
  /// `taken`: what the command writes besides.
  FailureName(const std::string& stem, const std::vector<std::string>& taken);
  /// Without ending.
  const std::string& prefix() const { return prefix_; }

 private:
  std::string prefix_;
  std::optional<UnfinishedPath> claim_;  ///< an empty file, made by one run only
};

/// The names of the files.
std::vector<std::string> failure_files(const std::string& prefix);

}  // namespace fastsplat::cli
