// SPDX-License-Identifier: Apache-2.0
// The merged results of a plan: one row per case, in the plan's order (docs/plan.md, "The merged file").
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/result.hpp"

namespace fastsplat::plan {

struct Row {
  std::string id, kind;
  Status status = Status::Pass;
  std::string message;
  Settings axes;
  std::vector<std::pair<std::string, double>> metrics;
  Content content;
  std::string program, command;

  std::optional<double> metric(const std::string& name) const;
};

struct Merged {
  std::string name, title, hash;  ///< of the plan
  std::string program;            ///< hash of the program that made every row
  std::vector<Axis> axes;
  std::vector<Metric> metrics;  ///< metrics of any row; `path` as in the rows' results
  std::vector<Row> rows;
  std::vector<std::string> missing;              ///< ids; only with MergeOptions::partial
  std::vector<nlohmann::ordered_json> coverage;  ///< a book for each configuration verified
};

struct MergeOptions {
  bool partial = false;        ///< missing and damaged results are left out and listed
  bool allow_foreign = false;  ///< results of cases outside the plan are ignored
};

/// Throws UserError (Input) that names results that are missing, damaged, of other content or programs, or outside the
/// plan.
Merged merge(const Plan& plan, const std::filesystem::path& results, const MergeOptions& options);

nlohmann::ordered_json to_json(const Merged& merged);
/// Throws UserError (Input) if the file is not a merged file.
Merged read_merged(const std::filesystem::path& path);

}  // namespace fastsplat::plan
