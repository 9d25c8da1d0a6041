// SPEC.toml: which kinds of case, over which axes, and what is the same in all (docs/plan.md, "The specification").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/sweep/metric.hpp"
#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// What a setting goes through. No value stands twice.
struct Axis {
  std::string name;
  std::vector<Value> values;
  bool is_label = false;  ///< shown in the results, and no word of any command
};

/// Axes of one length, which are gone through together.
using Zip = std::vector<Axis>;

struct Spec {
  std::filesystem::path file;  ///< files that settings name lie relative to its folder
  std::string name, title;
  std::vector<std::string> kinds;  ///< of each case, in order; at least one
  Settings constants;
  std::vector<Zip> axes;           ///< crossed, the last one fastest, as they stand in the file
  std::vector<Metric> metrics;     ///< besides those that the kinds have
  bool leave_out_refused = false;  ///< settings that do not go together make no case; else they are an error
};

/// Throws UserError (Input) with line and column for an invalid specification.
Spec read_spec(const std::filesystem::path& path);

}  // namespace fastsplat::plan
