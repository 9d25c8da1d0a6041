// SPDX-License-Identifier: Apache-2.0
// Chooses an unused default name for a failure's files, unique among concurrent runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/unfinished.hpp"

namespace fastsplat::cli {

/// The first free of STEM, STEM-2, STEM-3, ... It is reserved for this run until the object is destroyed, by which time
/// the files exist; concurrent runs in one folder never share it. UserError (Input) if the folder is not writable.
class FailureName {
 public:
  /// `taken`: other files that the command writes.
  FailureName(const std::string& stem, const std::vector<std::string>& taken);
  /// Without extension.
  const std::string& prefix() const { return prefix_; }

 private:
  std::string prefix_;
  std::optional<UnfinishedPath> claim_;  ///< an empty file, created exclusively
};

/// Names of the failure's files: PREFIX.fss (stream), PREFIX.fst (waveform) and PREFIX.gtkw (its view).
std::vector<std::string> failure_files(const std::string& prefix);

}  // namespace fastsplat::cli
