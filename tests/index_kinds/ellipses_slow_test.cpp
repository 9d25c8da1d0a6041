// SPDX-License-Identifier: Apache-2.0
// Elliptical footprints through the model's own unit, against golden's weights.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "analysis/index_kinds/ellipses.hpp"

namespace fastsplat::analysis {
namespace {

void print(const char* what, const EllipseErrors& e) {
  std::printf("[figure] %s: splats = %llu, pixels = %llu, aspect to %.3f, half axes to %.1f\n", what,
              static_cast<unsigned long long>(e.splats), static_cast<unsigned long long>(e.pixels), e.aspect,
              e.longest);
  std::printf("[figure] %s: ellipse max %.3f rms %.3f bias %+.3f; circle max %.3f rms %.3f bias %+.3f LSB8\n", what,
              e.ellipse.largest, e.ellipse.rms, e.ellipse.bias, e.circle.largest, e.circle.rms, e.circle.bias);
  std::printf("[figure] %s: q off by %.4f entries (limit %.4f), least q = %lld\n", what, e.entries_off, e.entries_bound,
              static_cast<long long>(e.least_q));
}

/// Largest error of one weight, 1/255, from three parts. Index: half an entry of the table plus the words' error in q,
/// at most 8/N an entry (a R^2 = 8). Word: half a word, and the one that the table's sum may have raised. Support:
/// exp(-8) at its edge, where one entry too many or too few may count.
double limit(const EllipseErrors& e) {
  return 255.0 * (8.0 / 1024 * (0.5 + e.entries_bound) + 1.5 * 0x1p-14) + 255.0 * std::exp(-8.0);
}

TEST(Ellipses, InPerspectiveAreGoldensToTheTablesSteps) {
  for (const double fov : {30.0, 90.0}) {
    const auto e = perspective_ellipses(fov);
    print(fov == 30.0 ? "fov 30" : "fov 90", e);
    EXPECT_GT(e.splats, 400U);
    EXPECT_LT(e.ellipse.largest, limit(e));
    EXPECT_LT(e.entries_off, e.entries_bound);
    EXPECT_GE(e.least_q, 0);
    EXPECT_GT(e.circle.rms, 2.0 * e.ellipse.rms) << "circles would have done";
  }
}

TEST(Ellipses, FlatOnesTooAndQIsNeverNegative) {
  const auto e = spread_ellipses(16.0);
  print("aspect 16", e);
  EXPECT_EQ(e.splats, 500U);
  EXPECT_GT(e.aspect, 15.0);
  EXPECT_GT(e.longest, 31.0);
  EXPECT_LT(e.ellipse.largest, limit(e));
  EXPECT_LT(e.entries_off, e.entries_bound);
  EXPECT_GT(e.entries_off, 0.0);
  EXPECT_GE(e.least_q, 0);
}

}  // namespace
}  // namespace fastsplat::analysis
