// SPDX-License-Identifier: Apache-2.0
// How flat a constant field stays after reconstruction, per kernel: against Poisson's summation formula and against the
// figures of splatting.md section 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

/// A kernel, and the published ripple of the sphere-truncated Gaussian of the same parameters in percent (0: none
/// given).
struct Row {
  double a, radius;
  double field_peak_to_peak;
  double xray_low, xray_high;
};
constexpr Row kTable[] = {
    {2.0, 2.0, 8.57, -2.84, 2.87},    {1.5, 2.0, 1.59, -0.47, 0.47}, {1.35, 2.0, 1.03, 0, 0},
    {1.0204, 3.0, 0.07, -0.02, 0.02}, {1.0, 3.0, 0.06, -0.02, 0.02},
};

/// Sum over integers k of exp(-a (k-x)^2), relative to its mean, at x = 0 (sign +1) and x = 1/2 (sign -1).
double theta(double a, double sign) {
  double sum = 1.0;
  double power = 1.0;
  for (int k = 1; k < 8; ++k) {
    power *= sign;
    sum += 2.0 * power * std::exp(-std::numbers::pi * std::numbers::pi * k * k / a);
  }
  return sum;
}

std::string name_of(const char* what, const Row& row) {
  char text[64];
  std::snprintf(text, sizeof text, "%s_a%g_R%g", what, row.a, row.radius);
  return text;
}

struct Range {
  double low = 1e9, high = -1e9;
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

constexpr int kPhases = 16;  // even: contains the phases 0 and 1/2 where the extremes lie

/// The part of the lattice sum that the cut at R removes from an endless Gaussian of unit mean, over all phases. In 2-D
/// these are the terms with |x| >= R, in 3-D the terms outside the cylinder |(x,y)| < R, |z| < R.
Range cut_away(double a, double radius, int dimensions) {
  Range range;
  const double norm = std::pow(a / std::numbers::pi, 0.5 * dimensions);
  const int reach = 9;
  const int z_phases = dimensions == 3 ? kPhases : 1;
  const int z_reach = dimensions == 3 ? reach : 0;
  for (int pz = 0; pz < z_phases; ++pz) {
    for (int py = 0; py < kPhases; ++py) {
      for (int px = 0; px < kPhases; ++px) {
        double sum = 0.0;
        for (int k = -z_reach; k <= z_reach; ++k) {
          for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
              const double x = i - px / double(kPhases);
              const double y = j - py / double(kPhases);
              const double z = k - pz / double(kPhases);
              if (x * x + y * y >= radius * radius || std::abs(z) >= radius)
                sum += std::exp(-a * (x * x + y * y + z * z));
            }
          }
        }
        range.include(norm * sum);
      }
    }
  }
  return range;
}

TEST(Flatness, FieldOfSummedKernels) {
  for (const Row& row : kTable) {
    const scene::Kernel kernel(row.a, row.radius);
    Range field;
    for (int pz = 0; pz < kPhases; ++pz) {
      for (int py = 0; py < kPhases; ++py) {
        for (int px = 0; px < kPhases; ++px) {
          double sum = 0.0;
          for (int k = -4; k <= 4; ++k) {
            for (int j = -4; j <= 4; ++j) {
              for (int i = -4; i <= 4; ++i) {
                const double x = i - px / double(kPhases);
                const double y = j - py / double(kPhases);
                sum += kernel.value(x * x + y * y, k - pz / double(kPhases));
              }
            }
          }
          field.include(sum);
        }
      }
    }
    // Endless Gaussian: the 1-D factor cubed. The cut reduces each value by the removed part, less the mean of that
    // part, which the normalisation over the support restores: at most the range of the cut.
    const Range cut = cut_away(row.a, row.radius, 3);
    const double tolerance = cut.high - cut.low + 1e-9;
    const double high = std::pow(theta(row.a, +1), 3);
    const double low = std::pow(theta(row.a, -1), 3);
    const double measured = 100.0 * (field.high - field.low);
    std::printf("a=%g R=%g: field %+.3f/%+.3f %%, theory %+.3f/%+.3f %% +-%.3f\n", row.a, row.radius,
                100 * (field.low - 1), 100 * (field.high - 1), 100 * (low - 1), 100 * (high - 1), 100 * tolerance);
    figure(name_of("field_ripple_percent", row), measured, "published value and theory, to the cut at R");
    EXPECT_NEAR(field.high, high, tolerance);
    EXPECT_NEAR(field.low, low, tolerance);
    EXPECT_NEAR(measured, row.field_peak_to_peak, 100 * 2 * tolerance + 0.005);
  }
}

TEST(Flatness, XRayOfOneLayer) {
  for (const Row& row : kTable) {
    // A layer of voxels facing the camera, 16 pixels a voxel; an odd image puts a pixel on the central voxel, so the
    // phases 0 and 1/2 are met exactly. Only pixels that no missing neighbour can reach are measured.
    Lattice lattice;
    lattice.dims = {19, 1, 19};
    lattice.a = row.a;
    lattice.radius = row.radius;
    lattice.pixels_per_mm = kPhases;
    lattice.width = lattice.height = 129;
    const scene::Scene scene = make_scene(lattice);
    const std::vector<scene::Splat> splats = scene::collect_splats(scene);
    ASSERT_EQ(splats.size(), 19u * 19u);
    const Image image = xray(scene, splats, {});

    Range sum;
    double total = 0.0;
    int pixels = 0;
    for (int y = 16; y < 112; ++y) {  // 6 periods of 16 phases
      for (int x = 16; x < 112; ++x) {
        const double value = image.pixel(x, y)[3] / splats[0].extinction;
        sum.include(value);
        total += value;
        ++pixels;
      }
    }
    const Range cut = cut_away(row.a, row.radius, 2);
    const double tolerance = cut.high - cut.low + 1e-6;  // 1e-6: float pixels and extinction
    const double high = std::pow(theta(row.a, +1), 2);
    const double low = std::pow(theta(row.a, -1), 2);
    std::printf("a=%g R=%g: X-ray %+.3f/%+.3f %%, mean %.6f, theory %+.3f/%+.3f %% +-%.3f\n", row.a, row.radius,
                100 * (sum.low - 1), 100 * (sum.high - 1), total / pixels, 100 * (low - 1), 100 * (high - 1),
                100 * tolerance);
    figure(name_of("xray_ripple_low_percent", row), 100 * (sum.low - 1), "theory, to the cut at R");
    figure(name_of("xray_ripple_high_percent", row), 100 * (sum.high - 1), "theory, to the cut at R");
    EXPECT_NEAR(sum.high, high, tolerance);
    EXPECT_NEAR(sum.low, low, tolerance);
    EXPECT_NEAR(total / pixels, 1.0, tolerance);
    if (row.xray_high > 0) {
      EXPECT_NEAR(100 * (sum.high - 1), row.xray_high, 100 * tolerance + 0.005);
      EXPECT_NEAR(100 * (sum.low - 1), row.xray_low, 100 * tolerance + 0.005);
    }
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
