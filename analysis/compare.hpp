// How far is TEST from REF: in LSB, in dB, where.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/image.hpp"

namespace fastsplat::analysis {

struct CompareOptions {
  int lsb_bits = 8;   ///< one LSB is 1/(2^bits - 1)
  double peak = 1.0;  ///< PSNR's peak, stated in the report
  int clusters = 5;   ///< worst clusters reported
  // Thresholds; absent ones are not applied. NaN/Inf fail unless allowed.
  std::optional<double> min_psnr_db, max_abs_lsb, max_mean_lsb, max_rmse_lsb, max_bias_lsb, max_p99_lsb, min_ssim;
  bool allow_nonfinite = false;
  int threads = 0;
};

struct Place {
  int x = 0, y = 0, channel = 0;
  double ref = 0, test = 0, error_lsb = 0;
};
struct Cluster {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double max_lsb = 0, sum_lsb = 0;
  Place worst;
};

struct Figures {
  double psnr_db = 0;  ///< +inf when identical; printed as "inf", null in JSON with "identical": true
  double max_abs_lsb = 0, mean_abs_lsb = 0, rmse_lsb = 0, bias_lsb = 0, ssim = 0;
  std::array<double, 6> percentiles_lsb{};  ///< p50 p90 p95 p99 p99.9 p99.99 of |error|
};

struct LimitApplied {
  std::string name;
  double limit = 0, got = 0;
  bool ok = false;
};

struct CompareReport {
  int width = 0, height = 0, channels = 0;
  std::uint64_t values = 0;  ///< compared channel values; 0 is a failure
  std::uint64_t nonfinite_ref = 0, nonfinite_test = 0;
  Figures figures;
  Figures floor;  ///< REF rounded once to the LSB grid against REF: nobody can do better at this width
  Place worst;
  std::vector<std::uint64_t> histogram;  ///< |error| in LSB: [0,0.5), [0.5,1.5), [1.5,2.5), ...
  std::vector<Cluster> clusters;
  std::vector<LimitApplied> limits;
  CompareOptions options;
  bool pass = false;
};

/// Sizes or channels that differ are a UserError (NotComparable).
CompareReport compare(const Image& ref, const Image& test, const CompareOptions& options = {});

std::string to_json(const CompareReport& report);
std::string to_text(const CompareReport& report);  ///< for a person, no colour

/// Signed LSB error per pixel (worst channel), diverging colours, with a legend in LSB. RGBA display image.
Image lsb_map(const Image& ref, const Image& test, const CompareOptions& options);
/// |error| on a logarithmic ramp with a legend.
Image heat_map(const Image& ref, const Image& test, const CompareOptions& options);

}  // namespace fastsplat::analysis
