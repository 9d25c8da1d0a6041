// SPDX-License-Identifier: Apache-2.0
// Bounds as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/errors/bound.hpp"
#include "base/progress.hpp"

namespace fastsplat::analysis {

struct BoundResult {
  Known known = Known::Scene;
  Bound bound;
  BoundCheck check;
};

/// All three levels.
struct BoundReport {
  stages::Picture real, device;
  std::vector<BoundResult> levels;
  bool holds() const;
};
BoundReport bounds(const stages::Chain& chain, int threads, const Progress& progress = {});

std::string to_text(const BoundReport& report, int bits);
/// Schema "fastsplat.bound/1".
nlohmann::ordered_json to_json(const BoundReport& report);

}  // namespace fastsplat::analysis
