// SPDX-License-Identifier: Apache-2.0
// SPEC.toml: the kinds of case, their axes and constants (docs/plan.md, "The specification").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/sweep/metric.hpp"
#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// A setting and its values, which are distinct except in a zip.
struct Axis {
  std::string name;
  std::vector<Value> values;
  bool is_label = false;  ///< shown in the results, but not part of any command
};

/// Axes of one length that advance together.
using Zip = std::vector<Axis>;

struct Spec {
  std::filesystem::path file;  ///< files in settings are relative to its folder
  std::string name, title;
  std::vector<std::string> kinds;  ///< of each case, in order; at least one
  Settings constants;
  std::vector<Zip> axes;           ///< crossed in the order of the file, the last one fastest
  std::vector<Metric> metrics;     ///< in addition to the kinds' own
  bool leave_out_refused = false;  ///< combinations that the program refuses are skipped; else they are an error
};

/// Throws UserError (Input) with line and column for an invalid specification.
Spec read_spec(const std::filesystem::path& path);

}  // namespace fastsplat::plan
