// SPDX-License-Identifier: Apache-2.0
#include "analysis/error_values.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/parallel/parallel.hpp"

namespace fastsplat::analysis {
namespace {

constexpr std::size_t kBlock = 65536;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string shape(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(image.channels);
}

void check_options(const CompareOptions& options) {
  if (options.lsb_bits < 1 || options.lsb_bits > 32) {
    throw_usage({"LSB bits", "out of range", "1 to 32", std::to_string(options.lsb_bits), {}});
  }
  if (!(options.peak > 0) || !std::isfinite(options.peak)) {
    throw_usage({"peak", "out of range", "a positive number", std::to_string(options.peak), {}});
  }
  if (options.clusters < 0)
    throw_usage({"clusters", "out of range", "0 or more", std::to_string(options.clusters), {}});
  for (const auto& limit : {options.min_psnr_db, options.max_abs_lsb, options.max_mean_lsb, options.max_rmse_lsb,
                            options.max_bias_lsb, options.max_p99_lsb, options.min_ssim}) {
    if (limit && std::isnan(*limit)) throw_usage({"threshold", "not a number", {}, {}, {}});
  }
}

template <typename Error>
std::vector<double> values_of(const Image& ref, const Image& test, int threads, const Error& error) {
  std::vector<double> errors(ref.data.size());
  for_blocks(errors.size(), kBlock, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool finite = std::isfinite(ref.data[i]) && std::isfinite(test.data[i]);
      errors[i] = finite ? error(double{ref.data[i]}, double{test.data[i]}) : kNaN;
    }
  });
  return errors;
}

}  // namespace

double lsb_per_unit(int bits) { return std::ldexp(1.0, bits) - 1.0; }

void check_comparable(const Image& ref, const Image& test, const CompareOptions& options) {
  check_options(options);
  const bool same_size = ref.width == test.width && ref.height == test.height;
  if (!same_size || ref.channels != test.channels) {
    throw UserError(ExitCode::NotComparable,
                    {.where = {},
                     .what = same_size ? "REF and TEST differ in channels" : "REF and TEST differ in size",
                     .expected = shape(ref),
                     .got = shape(test),
                     .fix = same_size ? "give both images the same channels (oiiotool --ch)"
                                      : "render both images at the same size"});
  }
  assert(ref.data.size() == static_cast<std::size_t>(ref.width) * ref.height * ref.channels);
  assert(test.data.size() == ref.data.size());
}

std::vector<double> error_values(const Image& ref, const Image& test, const CompareOptions& options) {
  const double unit = lsb_per_unit(options.lsb_bits);
  return values_of(ref, test, options.threads, [unit](double r, double t) { return (t - r) * unit; });
}

double rounded_once(double value, double unit) {
  const double rounded = std::floor(value * unit + 0.5) / unit;
  return static_cast<float>(rounded) == static_cast<float>(value) ? value : rounded;
}

std::vector<double> floor_values(const Image& ref, const Image& test, const CompareOptions& options) {
  const double unit = lsb_per_unit(options.lsb_bits);
  return values_of(ref, test, options.threads, [unit](double r, double) { return (rounded_once(r, unit) - r) * unit; });
}

std::vector<double> worst_channel(const std::vector<double>& errors, int channels) {
  std::vector<double> worst(errors.size() / static_cast<std::size_t>(channels), kNaN);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    double& pixel = worst[i / static_cast<std::size_t>(channels)];
    if (std::isnan(pixel) || std::abs(errors[i]) > std::abs(pixel)) pixel = errors[i];
  }
  return worst;
}

void for_blocks(std::size_t count, std::size_t block, int threads,
                const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
  parallel_for((count + block - 1) / block, threads,
               [&](std::size_t b) { body(b, b * block, std::min(count, (b + 1) * block)); });
}

}  // namespace fastsplat::analysis
