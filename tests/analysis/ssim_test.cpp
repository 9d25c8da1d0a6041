// SPDX-License-Identifier: Apache-2.0
// SSIM against a direct two-dimensional re-implementation of the paper's formula and against closed forms.
#include "analysis/ssim.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "tests/images/image_helper.hpp"

namespace fastsplat::analysis {
namespace {

RowSource rows(const Image& image) {
  return [&image](int channel, int y, double* row) {
    for (int x = 0; x < image.width; ++x) row[x] = image.pixel(x, y)[channel];
  };
}

double ssim_of(const Image& a, const Image& b, int threads = 1) {
  return ssim(a.width, a.height, a.channels, 1.0, threads, rows(a), rows(b));
}

/// The definition, window by window: weighted means first, then central moments.
double direct_ssim(const Image& a, const Image& b) {
  constexpr double c1 = 1e-4, c2 = 9e-4;
  double sum = 0;
  int windows = 0;
  for (int c = 0; c < a.channels; ++c) {
    for (int y = 5; y + 5 < a.height; ++y) {
      for (int x = 5; x + 5 < a.width; ++x) {
        const auto each = [&](auto visit) {
          for (int dy = -5; dy <= 5; ++dy) {
            for (int dx = -5; dx <= 5; ++dx) {
              visit(std::exp(-(dx * dx + dy * dy) / 4.5), a.pixel(x + dx, y + dy)[c], b.pixel(x + dx, y + dy)[c]);
            }
          }
        };
        double weights = 0, mean_a = 0, mean_b = 0, var_a = 0, var_b = 0, cov = 0;
        each([&](double w, double va, double vb) { weights += w, mean_a += w * va, mean_b += w * vb; });
        mean_a /= weights, mean_b /= weights;
        each([&](double w, double va, double vb) {
          var_a += w / weights * (va - mean_a) * (va - mean_a);
          var_b += w / weights * (vb - mean_b) * (vb - mean_b);
          cov += w / weights * (va - mean_a) * (vb - mean_b);
        });
        sum += (2 * mean_a * mean_b + c1) * (2 * cov + c2) /
               ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
        ++windows;
      }
    }
  }
  return sum / windows;
}

TEST(Ssim, IsTheDefinition) {
  // Second moments of values below 1 lose at most 121 * 2^-52 in the sums; divided by c2 that is 3e-11.
  constexpr double kTolerance = 1e-10;
  double worst = 0;
  for (const auto& [width, height, channels] : {std::array{11, 11, 1}, std::array{40, 23, 3}, std::array{17, 90, 4}}) {
    const Image a = images::random_image(width, height, channels, 1);
    Image b = images::random_image(width, height, channels, 2);
    for (std::size_t i = 0; i < b.data.size(); ++i) b.data[i] = 0.7f * a.data[i] + 0.2f * b.data[i];
    worst = std::max(worst, std::abs(ssim_of(a, b) - direct_ssim(a, b)));
    EXPECT_EQ(ssim_of(a, b, 1), ssim_of(a, b, 2));
  }
  std::printf("[figure] SSIM against the direct sum: difference = %.1e (limit %.0e)\n", worst, kTolerance);
  EXPECT_LT(worst, kTolerance);
}

TEST(Ssim, ConstantImagesHaveAClosedForm) {
  Image a(16, 16, 1), b(16, 16, 1);
  for (float& value : a.data) value = 0.5f;
  for (float& value : b.data) value = 0.625f;
  EXPECT_NEAR(ssim_of(a, b), (2 * 0.5 * 0.625 + 1e-4) / (0.25 + 0.390625 + 1e-4), 1e-12);
}

TEST(Ssim, OppositeStructureIsNegative) {
  Image a(32, 32, 1), b(32, 32, 1);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      a.pixel(x, y)[0] = (x + y) % 2 == 0 ? 0.2f : 0.8f;
      b.pixel(x, y)[0] = 1.0f - a.pixel(x, y)[0];
    }
  }
  // Equal means, covariance = -variance = -0.09: (c2 - 0.18) / (c2 + 0.18).
  EXPECT_NEAR(ssim_of(a, b), (9e-4 - 0.18) / (9e-4 + 0.18), 1e-3);
}

TEST(Ssim, LeavesOutWindowsWithoutNumbers) {
  const Image a = images::random_image(40, 30, 1, 1);
  Image b = images::random_image(40, 30, 1, 2);
  // One NaN in the last column touches only windows whose right edge is there: as if the image ended one column earlier
  // in 11 rows. In a column that every row covers, exactly so.
  Image narrow_a(39, 30, 1), narrow_b(39, 30, 1);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 39; ++x) {
      narrow_a.pixel(x, y)[0] = a.pixel(x, y)[0];
      narrow_b.pixel(x, y)[0] = b.pixel(x, y)[0];
    }
    b.pixel(39, y)[0] = std::numeric_limits<float>::quiet_NaN();
  }
  EXPECT_NEAR(ssim_of(a, b), ssim_of(narrow_a, narrow_b), 1e-13);
  for (float& value : b.data) value = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(std::isnan(ssim_of(a, b)));
}

}  // namespace
}  // namespace fastsplat::analysis
