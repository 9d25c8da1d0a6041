// A figure of a row: its name, what it means, and where in the verbs' JSON it stands.
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
  /// In a case's results, from the verb on: "compare/psnr_db". An element `*` is every number of an object, `*name`
  /// every element of a list, identified by its `name`: the metric's name then has a `*` for that word.
  std::string path;
  bool operator==(const Metric&) const = default;
};

/// Those of the program's verbs. Several may have one name: then the first that a case has is meant.
const std::vector<Metric>& known_metrics();

/// A case's numbers in the order of `metrics`; what is not there, or no number, is left out. `results`: by verb.
struct Figure {
  Metric metric;  ///< with its own name and path: no `*` in it
  double value = 0.0;
};
std::vector<Figure> figures(const nlohmann::ordered_json& results, const std::vector<Metric>& metrics);

}  // namespace fastsplat::plan
