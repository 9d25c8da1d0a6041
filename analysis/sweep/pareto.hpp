// SPDX-License-Identifier: Apache-2.0
// The Pareto front of rows by two metrics, and for every other row one of the front that beats it.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/merged.hpp"

namespace fastsplat::plan {

struct Beaten {
  const Row* row = nullptr;
  const Row* by = nullptr;  ///< of the front: at least as good in both, better in one
};

struct Pareto {
  Metric x, y;
  std::vector<const Row*> front;    ///< by x, the best one first
  std::vector<Beaten> beaten;       ///< in the rows' order
  std::vector<const Row*> without;  ///< rows that did not pass, or lack one of the metrics
};

/// A metric by its name. "-" before it means that less is better, "+" that more is, for metrics that do not define
/// this. Throws UserError (Usage) for unknown metrics and for metrics without a direction.
Metric metric_of(const Merged& merged, const std::string& name, const char* flag);

/// Rows that are equal in both metrics are all on the front.
Pareto pareto(const std::vector<const Row*>& rows, const Metric& x, const Metric& y);

}  // namespace fastsplat::plan
