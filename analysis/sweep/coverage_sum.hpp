// Books of coverage, as `verify --coverage` writes them, added up.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastsplat::plan {

/// One book for each configuration, in the order in which they came.
class CoverageSum {
 public:
  /// Adds counts, and the bins of every campaign. Throws UserError (Input) for an invalid book and for one of another
  /// configuration; `where` names it.
  void add(const nlohmann::ordered_json& book, const std::string& where);

  const std::vector<nlohmann::ordered_json>& books() const { return books_; }

 private:
  std::vector<nlohmann::ordered_json> books_;
};

}  // namespace fastsplat::plan
