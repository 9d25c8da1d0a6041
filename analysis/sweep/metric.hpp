// SPDX-License-Identifier: Apache-2.0
// A metric: its name, its meaning, and its place in the JSON of the subcommands.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace fastsplat::plan {

enum class Better { Less, More, Neither };

const char* to_string(Better better);  ///< "less", "more", ""

struct Metric {
  std::string name, title, unit;
  Better better = Better::Neither;
  /// In a case's results, from the subcommand on: "compare/psnr_db". `*` matches every number of an object, `*name`
  /// every element of a list, identified by its `name`. The metric's name then has a `*` for that word.
  std::string path;
  bool operator==(const Metric&) const = default;
};

/// Metrics of the program's subcommands. If several have one name, the first that a case has is used.
const std::vector<Metric>& known_metrics();

struct Figure {
  Metric metric;  ///< its own name and path, without `*`
  double value = 0.0;
};
/// A case's numbers in the order of `metrics`; missing and non-numeric ones are left out. `results`: by subcommand.
std::vector<Figure> figures(const nlohmann::ordered_json& results, const std::vector<Metric>& metrics);

}  // namespace fastsplat::plan
