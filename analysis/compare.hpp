// SPDX-License-Identifier: Apache-2.0
// Compares TEST with REF: errors in LSB and dB, and where they are.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/image.hpp"

namespace fastsplat::analysis {

struct CompareOptions {
  int lsb_bits = 8;   ///< 1 to 32; one LSB is 1/(2^bits - 1)
  double peak = 1.0;  ///< PSNR's peak and SSIM's L, stated in the report
  int clusters = 5;   ///< worst clusters reported
  // Thresholds; absent ones are not applied. max_bias_lsb bounds |bias|. NaN/Inf fail unless allowed.
  std::optional<double> min_psnr_db = {}, max_abs_lsb = {}, max_mean_lsb = {}, max_rmse_lsb = {}, max_bias_lsb = {},
                        max_p99_lsb = {}, min_ssim = {};
  bool allow_nonfinite = false;
  bool similarity = true;  ///< SSIM, the slowest figure; NaN without
  int threads = 0;         ///< 0: all cores. Never changes the result.
};

/// One channel value; of equal errors the first in row order. error_lsb is signed: test - ref.
struct Place {
  int x = 0, y = 0, channel = 0;
  double ref = 0, test = 0, error_lsb = 0;
};

/// An 8-connected group of pixels whose worst channel errs by at least CompareReport::cluster_threshold_lsb.
struct Cluster {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< bounding box, both corners included
  std::uint64_t pixels = 0;
  double max_lsb = 0, sum_lsb = 0;  ///< of the worst channel's |error| per pixel
  Place worst;
};

/// Over all finite values of all channels alike, alpha included (docs/compare.md has the formulas). NaN if no value is
/// finite.
struct Figures {
  double psnr_db = 0;  ///< +inf when identical; printed as "inf", null in JSON with "identical": true
  double max_abs_lsb = 0, mean_abs_lsb = 0, rmse_lsb = 0, bias_lsb = 0;
  double ssim = 0;                          ///< Wang 2004, windows wholly inside the image
  std::array<double, 6> percentiles_lsb{};  ///< p50 p90 p95 p99 p99.9 p99.99 of |error|, nearest rank
};

/// `name` as in CompareOptions; "min_values" and, unless allowed, "max_nonfinite" are always among them.
struct LimitApplied {
  std::string name;
  double limit = 0, got = 0;
  bool ok = false;
};

struct CompareReport {
  int width = 0, height = 0, channels = 0;
  std::uint64_t values = 0;  ///< compared channel values: finite in both; 0 is a failure
  std::uint64_t nonfinite_ref = 0, nonfinite_test = 0;
  Figures figures;
  Figures floor;  ///< REF rounded once to the LSB grid (half up, no clamp) against REF: the error of this width alone
  Place worst;
  /// |error| in LSB: [0,0.5), [0.5,1.5), [1.5,2.5), ... up to the worst; a 257th bin holds everything from 255.5 on.
  std::vector<std::uint64_t> histogram;
  double cluster_threshold_lsb = 1;  ///< the larger of 1 LSB and p99.9
  std::vector<Cluster> clusters;     ///< worst first: by max, then sum, then place
  std::vector<LimitApplied> limits;
  CompareOptions options;
  bool pass = false;  ///< every applied limit is kept
};

/// Throws UserError (NotComparable) if sizes or channels differ, UserError (Usage) if options are out of range.
CompareReport compare(const Image& ref, const Image& test, const CompareOptions& options = {});

/// One JSON object, schema "fastsplat.compare/1" (docs/compare.md). Strict: NaN and infinity are null.
std::string to_json(const CompareReport& report);
std::string to_text(const CompareReport& report);  ///< for a person, no colour

// Maps: RGBA, opaque, linear as every Image, to be written with images::WriteOptions::display. The picture sits at the
// top left, pixel for pixel (images narrower than 256 pixels are enlarged by a whole factor), a legend in LSB below it.

/// Signed error of the worst channel: blue where TEST is below REF, red where above, light grey at 0.
Image lsb_map(const Image& ref, const Image& test, const CompareOptions& options);
/// |error| of the worst channel on a logarithmic ramp from 1/16 LSB.
Image heat_map(const Image& ref, const Image& test, const CompareOptions& options);

}  // namespace fastsplat::analysis
