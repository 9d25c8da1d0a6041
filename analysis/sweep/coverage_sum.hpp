// SPDX-License-Identifier: Apache-2.0
// Sums coverage books as `verify --coverage` writes them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastsplat::plan {

/// One book for each configuration, in order of first appearance.
class CoverageSum {
 public:
  /// Adds counts, and the bins of every campaign. Throws UserError (Input) that names `where` for an invalid book, and
  /// for one whose other values differ from earlier books of its configuration.
  void add(const nlohmann::ordered_json& book, const std::string& where);

  const std::vector<nlohmann::ordered_json>& books() const { return books_; }

 private:
  std::vector<nlohmann::ordered_json> books_;
};

}  // namespace fastsplat::plan
