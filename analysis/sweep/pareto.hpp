// Which rows are worth having by two metrics, and by which of these every other row is beaten.
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

/// A metric by its name, with "-" before it where less is better and "+" where more is, as far as it does not say so
/// itself. UserError (Usage) for metrics that there are none of, and for those without a direction.
Metric metric_of(const Merged& merged, const std::string& name, const char* flag);

/// Rows that are equal in both metrics are all on the front.
Pareto pareto(const std::vector<const Row*>& rows, const Metric& x, const Metric& y);

}  // namespace fastsplat::plan
