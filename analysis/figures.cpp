// SPDX-License-Identifier: Apache-2.0
#include "analysis/figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/error_values.hpp"

namespace fastsplat::analysis {
namespace {

constexpr std::size_t kSumBlock = 65536;
constexpr std::size_t kMostBins = 257;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

std::size_t bin_of(double magnitude) {
  return magnitude + 0.5 >= static_cast<double>(kMostBins) ? kMostBins - 1 : static_cast<std::size_t>(magnitude + 0.5);
}

ErrorSums sum_block(const std::vector<double>& errors, std::size_t begin, std::size_t end) {
  ErrorSums sums;
  sums.histogram.assign(kMostBins, 0);
  for (std::size_t i = begin; i < end; ++i) {
    const double error = errors[i];
    if (std::isnan(error)) continue;
    const double magnitude = std::abs(error);
    ++sums.count;
    sums.sum += error;
    sums.sum_abs += magnitude;
    sums.sum_squares += error * error;
    ++sums.histogram[bin_of(magnitude)];
    if (magnitude > sums.max_abs) {
      sums.max_abs = magnitude;
      sums.worst = i;
    }
  }
  return sums;
}

void add(ErrorSums& total, const ErrorSums& block) {
  total.count += block.count;
  total.sum += block.sum;
  total.sum_abs += block.sum_abs;
  total.sum_squares += block.sum_squares;
  for (std::size_t b = 0; b < kMostBins; ++b) total.histogram[b] += block.histogram[b];
  if (block.max_abs > total.max_abs) {
    total.max_abs = block.max_abs;
    total.worst = block.worst;
  }
}

}  // namespace

ErrorSums sum_errors(const std::vector<double>& errors, int threads) {
  std::vector<ErrorSums> blocks((errors.size() + kSumBlock - 1) / kSumBlock);
  for_blocks(errors.size(), kSumBlock, threads, [&](std::size_t block, std::size_t begin, std::size_t end) {
    blocks[block] = sum_block(errors, begin, end);
  });
  ErrorSums total;
  total.histogram.assign(kMostBins, 0);
  for (const auto& block : blocks) add(total, block);
  while (!total.histogram.empty() && total.histogram.back() == 0) total.histogram.pop_back();
  return total;
}

std::span<const Percentile, 6> percentiles() {
  static constexpr std::array<Percentile, 6> kPercentiles{{{"p50", 1, 2},
                                                           {"p90", 9, 10},
                                                           {"p95", 19, 20},
                                                           {"p99", 99, 100},
                                                           {"p99.9", 999, 1000},
                                                           {"p99.99", 9999, 10000}}};
  return kPercentiles;
}

std::array<double, 6> percentile_values(const std::vector<double>& errors) {
  std::vector<double> magnitudes;
  magnitudes.reserve(errors.size());
  for (const double error : errors) {
    if (!std::isnan(error)) magnitudes.push_back(std::abs(error));
  }
  std::array<double, 6> values{};
  values.fill(kUndefined);
  const std::uint64_t count = magnitudes.size();
  if (count == 0) return values;
  // From the highest down, each selection only has to look below the last one.
  auto end = magnitudes.end();
  for (std::size_t p = values.size(); p-- > 0;) {
    const auto& [name, parts, of] = percentiles()[p];
    const std::uint64_t rank = (count * parts + of - 1) / of;
    const auto nth = magnitudes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    if (nth < end) std::nth_element(magnitudes.begin(), nth, end);
    values[p] = *nth;
    end = nth;
  }
  return values;
}

Figures figures_of(const std::vector<double>& errors, const ErrorSums& sums, const CompareOptions& options) {
  Figures figures;
  figures.percentiles_lsb = percentile_values(errors);
  if (sums.count == 0) {
    figures.psnr_db = figures.max_abs_lsb = figures.mean_abs_lsb = figures.rmse_lsb = figures.bias_lsb = kUndefined;
    return figures;
  }
  const double count = static_cast<double>(sums.count);
  figures.max_abs_lsb = sums.max_abs;
  figures.mean_abs_lsb = sums.sum_abs / count;
  figures.rmse_lsb = std::sqrt(sums.sum_squares / count);
  figures.bias_lsb = sums.sum / count;
  figures.psnr_db = sums.max_abs == 0
                        ? std::numeric_limits<double>::infinity()
                        : 20.0 * std::log10(options.peak * lsb_per_unit(options.lsb_bits) / figures.rmse_lsb);
  return figures;
}

}  // namespace fastsplat::analysis
