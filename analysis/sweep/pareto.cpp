// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/pareto.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/suggest.hpp"

namespace fastsplat::plan {
namespace {

/// The value such that less is better.
double badness(const Row& row, const Metric& metric) {
  const double value = *row.metric(metric.name);
  return metric.better == Better::More ? -value : value;
}

}  // namespace

Metric metric_of(const Merged& merged, const std::string& name, const char* flag) {
  const bool less = name.starts_with('-'), more = name.starts_with('+');
  const std::string plain = less || more ? name.substr(1) : name;
  const auto found = std::ranges::find(merged.metrics, plain, &Metric::name);
  if (found == merged.metrics.end()) {
    std::vector<std::string> known;
    for (const Metric& metric : merged.metrics) known.push_back(metric.name);
    throw_usage({.where = flag,
                 .what = "unknown metric '" + plain + "'",
                 .expected = {},
                 .got = {},
                 .fix = suggestion(plain, known)});
  }
  Metric metric = *found;
  if (less) metric.better = Better::Less;
  if (more) metric.better = Better::More;
  if (metric.better == Better::Neither) {
    throw_usage({.where = flag,
                 .what = plain + " has no preferred direction",
                 .expected = {},
                 .got = {},
                 .fix = std::string(flag) + "=-" + plain + " if less is better, or " + flag + "=+" + plain +
                        " if more is better"});
  }
  return metric;
}

Pareto pareto(const std::vector<const Row*>& rows, const Metric& x, const Metric& y) {
  Pareto out{.x = x, .y = y, .front = {}, .beaten = {}, .without = {}};
  std::vector<const Row*> sorted;
  for (const Row* row : rows) {
    const bool whole = row->status == Status::Pass && row->metric(x.name) && row->metric(y.name);
    (whole ? sorted : out.without).push_back(row);
  }
  std::ranges::stable_sort(sorted, {}, [&](const Row* row) { return std::pair(badness(*row, x), badness(*row, y)); });
  std::vector<std::pair<const Row*, const Row*>> beaten_by;
  for (const Row* row : sorted) {
    const Row* last = out.front.empty() ? nullptr : out.front.back();
    const bool equal =
        last != nullptr && badness(*row, x) == badness(*last, x) && badness(*row, y) == badness(*last, y);
    if (last == nullptr || equal || badness(*row, y) < badness(*last, y)) {
      out.front.push_back(row);
    } else {
      // Of the front's rows that beat it, the best in x: the cheapest way to the same y.
      const auto by =
          std::ranges::find_if(out.front, [&](const Row* other) { return badness(*other, y) <= badness(*row, y); });
      beaten_by.emplace_back(row, *by);
    }
  }
  for (const Row* row : rows) {
    const auto found = std::ranges::find(beaten_by, row, &std::pair<const Row*, const Row*>::first);
    if (found != beaten_by.end()) out.beaten.push_back({row, found->second});
  }
  return out;
}

}  // namespace fastsplat::plan
