// SPDX-License-Identifier: Apache-2.0
// The figures of one error field: sums, extremes, order statistics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/compare.hpp"

namespace fastsplat::analysis {

/// One pass over error_values(): everything that needs no sorting.
struct ErrorSums {
  std::uint64_t count = 0;  ///< finite errors
  double sum = 0, sum_abs = 0, sum_squares = 0;
  double max_abs = -1;
  std::size_t worst = 0;  ///< index of the first value that reaches max_abs
  std::vector<std::uint64_t> histogram;
};
ErrorSums sum_errors(const std::vector<double>& errors, int threads);

/// A percentile as an exact fraction of the values.
struct Percentile {
  const char* name;
  std::uint64_t parts, of;
};
std::span<const Percentile, 6> percentiles();

/// Nearest rank: of n sorted magnitudes the ceil(n * parts / of)-th smallest. An exact value of the data, no
/// interpolation.
std::array<double, 6> percentile_values(const std::vector<double>& errors);

/// All figures but the SSIM.
Figures figures_of(const std::vector<double>& errors, const ErrorSums& sums, const CompareOptions& options);

}  // namespace fastsplat::analysis
