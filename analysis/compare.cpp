// SPDX-License-Identifier: Apache-2.0
#include "analysis/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/clusters.hpp"
#include "analysis/error_values.hpp"
#include "analysis/figures.hpp"
#include "analysis/ssim.hpp"

namespace fastsplat::analysis {
namespace {

std::uint64_t count_nonfinite(const Image& image) {
  return static_cast<std::uint64_t>(
      std::count_if(image.data.begin(), image.data.end(), [](float value) { return !std::isfinite(value); }));
}

/// Rows of map(ref, test) in double; NaN where either is not finite.
template <typename Map>
RowSource rows_of(const Image& ref, const Image& test, Map map) {
  return [&ref, &test, map](int channel, int y, double* row) {
    for (int x = 0; x < ref.width; ++x) {
      const double r = ref.pixel(x, y)[channel];
      const double t = test.pixel(x, y)[channel];
      row[x] = std::isfinite(r) && std::isfinite(t) ? map(r, t) : std::numeric_limits<double>::quiet_NaN();
    }
  };
}

Place place_at(const Image& ref, const Image& test, const std::vector<double>& errors, std::size_t i) {
  const auto channels = static_cast<std::size_t>(ref.channels);
  const auto width = static_cast<std::size_t>(ref.width);
  return {.x = static_cast<int>(i / channels % width),
          .y = static_cast<int>(i / channels / width),
          .channel = static_cast<int>(i % channels),
          .ref = ref.data[i],
          .test = test.data[i],
          .error_lsb = errors[i]};
}

/// The channel whose error stands for the pixel.
Place worst_of_pixel(const Image& ref, const Image& test, const std::vector<double>& errors, const Place& at) {
  std::size_t i = (static_cast<std::size_t>(at.y) * ref.width + at.x) * ref.channels;
  while (errors[i] != at.error_lsb) ++i;
  return place_at(ref, test, errors, i);
}

void add_limits(CompareReport& report) {
  const auto apply_if = [&](const char* name, const std::optional<double>& limit, double got, bool at_least) {
    if (limit) report.limits.push_back({name, *limit, got, at_least ? got >= *limit : got <= *limit});
  };
  const auto& options = report.options;
  const auto& figures = report.figures;
  apply_if("min_psnr_db", options.min_psnr_db, figures.psnr_db, true);
  apply_if("max_abs_lsb", options.max_abs_lsb, figures.max_abs_lsb, false);
  apply_if("max_mean_lsb", options.max_mean_lsb, figures.mean_abs_lsb, false);
  apply_if("max_rmse_lsb", options.max_rmse_lsb, figures.rmse_lsb, false);
  apply_if("max_bias_lsb", options.max_bias_lsb, std::abs(figures.bias_lsb), false);
  apply_if("max_p99_lsb", options.max_p99_lsb, figures.percentiles_lsb[3], false);
  apply_if("min_ssim", options.min_ssim, figures.ssim, true);
  apply_if("min_values", 1.0, static_cast<double>(report.values), true);
  if (!options.allow_nonfinite) {
    apply_if("max_nonfinite", 0.0, static_cast<double>(report.nonfinite_ref + report.nonfinite_test), false);
  }
  report.pass = std::all_of(report.limits.begin(), report.limits.end(), [](const auto& limit) { return limit.ok; });
}

}  // namespace

CompareReport compare(const Image& ref, const Image& test, const CompareOptions& options) {
  check_comparable(ref, test, options);
  CompareReport report;
  report.width = ref.width;
  report.height = ref.height;
  report.channels = ref.channels;
  report.options = options;
  report.nonfinite_ref = count_nonfinite(ref);
  report.nonfinite_test = count_nonfinite(test);

  const double unit = lsb_per_unit(options.lsb_bits);
  const auto similarity = [&](auto map) {
    if (!options.similarity) return std::numeric_limits<double>::quiet_NaN();
    return ssim(ref.width, ref.height, ref.channels, options.peak, options.threads,
                rows_of(ref, test, [](double r, double) { return r; }), rows_of(ref, test, map));
  };

  {  // The floor first, so that only one error field is alive at a time.
    const auto errors = floor_values(ref, test, options);
    report.floor = figures_of(errors, sum_errors(errors, options.threads), options);
    report.floor.ssim = similarity([unit](double r, double) { return rounded_once(r, unit); });
  }

  const auto errors = error_values(ref, test, options);
  const ErrorSums sums = sum_errors(errors, options.threads);
  report.values = sums.count;
  report.histogram = sums.histogram;
  report.figures = figures_of(errors, sums, options);
  report.figures.ssim = similarity([](double, double t) { return t; });

  if (report.values > 0) {
    report.worst = place_at(ref, test, errors, sums.worst);
    report.cluster_threshold_lsb = std::max(1.0, report.figures.percentiles_lsb[4]);
    report.clusters = find_clusters(worst_channel(errors, ref.channels), ref.width, ref.height,
                                    report.cluster_threshold_lsb, options.clusters);
    for (Cluster& cluster : report.clusters) cluster.worst = worst_of_pixel(ref, test, errors, cluster.worst);
  }
  add_limits(report);
  return report;
}

}  // namespace fastsplat::analysis
