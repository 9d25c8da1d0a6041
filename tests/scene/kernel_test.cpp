// SPDX-License-Identifier: Apache-2.0
// The kernel's closed forms against midpoint quadrature of value(), the only function that is a definition.
#include "scene/kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

struct Shape {
  double a, radius;
};
void PrintTo(const Shape& shape, std::ostream* out) { *out << "a=" << shape.a << ",R=" << shape.radius; }

class KernelIntegrals : public ::testing::TestWithParam<Shape> {
 protected:
  Kernel kernel_{GetParam().a, GetParam().radius};
};

constexpr int kSteps = 20000;
/// Midpoint rule: (b-a) h^2 / 24 max|f''|, and f'' of N exp(-a z^2) is at most 2 a N.
double midpoint_bound(const Kernel& kernel) {
  const double step = 2.0 * kernel.radius() / kSteps;
  return 2.0 * kernel.radius() * step * step / 24.0 * 2.0 * kernel.a() * kernel.value(0.0, 0.0) + 1e-12;
}

double line_integral(const Kernel& kernel, double rho2, double from, double to) {
  const double step = (to - from) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += kernel.value(rho2, from + (i + 0.5) * step);
  return sum * step;
}

TEST_P(KernelIntegrals, FootprintIsTheLineIntegral) {
  const double limit = midpoint_bound(kernel_);
  double worst = 0.0;
  int compared = 0;
  for (double rho = 0.0; rho < kernel_.radius() + 0.3; rho += 0.1, ++compared) {
    const double r = kernel_.radius();
    worst = std::max(worst, std::abs(kernel_.footprint(rho * rho) - line_integral(kernel_, rho * rho, -r, r)));
  }
  ASSERT_GT(compared, 5);
  std::printf("[figure] footprint against quadrature, a=%g R=%g = %.3g (limit %.3g)\n", kernel_.a(), kernel_.radius(),
              worst, limit);
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(worst, limit);
  EXPECT_DOUBLE_EQ(kernel_.footprint(0.0), kernel_.peak());
}

TEST_P(KernelIntegrals, CumulativeIsTheShareInFront) {
  const double limit = 2.0 * midpoint_bound(kernel_) / kernel_.peak();
  double worst = 0.0;
  for (double z = -kernel_.radius(); z <= kernel_.radius(); z += 0.125) {
    const double share = line_integral(kernel_, 0.0, -kernel_.radius(), z) / kernel_.peak();
    worst = std::max(worst, std::abs(kernel_.cumulative(z) - share));
  }
  std::printf("[figure] cumulative against quadrature, a=%g R=%g = %.3g (limit %.3g)\n", kernel_.a(), kernel_.radius(),
              worst, limit);
  EXPECT_LE(worst, limit);
}

TEST_P(KernelIntegrals, CumulativeIsExactAtTheEndsAndNeverFalls) {
  const double r = kernel_.radius();
  for (const double z : {-r, std::nextafter(-r, -1e9), -100.0, -static_cast<double>(INFINITY)})
    EXPECT_EQ(kernel_.cumulative(z), 0.0);
  for (const double z : {r, std::nextafter(r, 1e9), 100.0, static_cast<double>(INFINITY)})
    EXPECT_EQ(kernel_.cumulative(z), 1.0);
  EXPECT_EQ(kernel_.cumulative(0.0), 0.5);
  double before = 0.0;
  for (int i = -1000; i <= 1000; ++i) {
    const double share = kernel_.cumulative(1.1 * r * i / 1000.0);
    EXPECT_GE(share, before);
    EXPECT_LE(share, 1.0);
    before = share;
  }
}

TEST_P(KernelIntegrals, TheWholeIsOne) {
  // Rings: 2 pi rho F(rho), midpoint; the integrand's second derivative is below 2 pi peak (3 a + 2 a^2 R ...) < 40
  // a^2.
  constexpr int kRings = 20000;
  const double step = kernel_.radius() / kRings;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double rho = (i + 0.5) * step;
    sum += 2.0 * std::numbers::pi * rho * kernel_.footprint(rho * rho) * step;
  }
  const double limit = kernel_.radius() * step * step / 24.0 * 40.0 * kernel_.a() * (kernel_.a() + 1.0) + 1e-12;
  std::printf("[figure] volume under the kernel - 1, a=%g R=%g = %.3g (limit %.3g)\n", kernel_.a(), kernel_.radius(),
              sum - 1.0, limit);
  EXPECT_NEAR(sum, 1.0, limit);
}

// N-8-40: v.
TEST_P(KernelIntegrals, VarianceIsTheFootprintsSecondMoment) {
  // Rings: pi rho^3 F(rho) by the midpoint rule. With t = sqrt(a) rho the second derivative is below sqrt(a) (6t +
  // 14t^3 + 4t^5) exp(-t^2) < 11 sqrt(a), divided by the part of the volume that the cut at R leaves.
  constexpr int kRings = 20000;
  const double a = kernel_.a(), r = kernel_.radius();
  const double step = r / kRings;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double rho = (i + 0.5) * step;
    sum += std::numbers::pi * rho * rho * rho * kernel_.footprint(rho * rho) * step;
  }
  const double limit = r * step * step / 24.0 * 11.0 * std::sqrt(a) / -std::expm1(-a * r * r) + 1e-12;
  std::printf("[figure] variance of the footprint - quadrature, a=%g R=%g = %.3g (limit %.3g)\n", a, r,
              kernel_.variance() - sum, limit);
  EXPECT_NEAR(kernel_.variance(), sum, limit);
  EXPECT_GT(sum, 0.2 * std::min(0.5 / a, r * r / 4));
}

TEST_P(KernelIntegrals, SupportIsStrict) {
  const double r = kernel_.radius();
  EXPECT_EQ(kernel_.footprint(r * r), 0.0);
  EXPECT_GT(kernel_.footprint(std::nextafter(r * r, 0.0)), 0.0);
  EXPECT_EQ(kernel_.value(0.0, r), 0.0);
  EXPECT_EQ(kernel_.value(r * r, 0.0), 0.0);
  EXPECT_GT(kernel_.value(0.0, std::nextafter(-r, 0.0)), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, KernelIntegrals,
                         ::testing::Values(Shape{2.0, 2.0}, Shape{1.35, 2.0}, Shape{1.02, 3.0}, Shape{0.1, 0.5},
                                           Shape{20.0, 4.0}));

TEST(Kernel, MeanOverTheLatticeIsOne) {
  // The mean over 8^3 phases of the unit cell is the integral, up to aliases of order exp(-64 pi^2 / a). Sampling the
  // cut at R adds an error; the kernel is at most exp(-a R^2) = 3.4e-4 of its peak there.
  const Kernel kernel = kernel_by_name("gauss2");
  double sum = 0.0;
  for (int x = -24; x < 24; ++x) {
    for (int y = -24; y < 24; ++y) {
      for (int z = -24; z < 24; ++z) {
        const double dx = (x + 0.5) / 8, dy = (y + 0.5) / 8, dz = (z + 0.5) / 8;
        sum += kernel.value(dx * dx + dy * dy, dz) / 512.0;
      }
    }
  }
  const double limit = 3.4e-4;
  std::printf("[figure] mean of sum_k h(x-k) - 1 = %.3g (limit %.3g)\n", sum - 1.0, limit);
  EXPECT_NEAR(sum, 1.0, limit);
}

TEST(Kernel, NamesAndLimits) {
  EXPECT_EQ(kernel_by_name("gauss2").a(), 2.0);
  EXPECT_EQ(kernel_by_name("smooth").a(), 1.35);
  for (const auto& name : kernel_names()) EXPECT_NO_THROW(kernel_by_name(name));
  EXPECT_THAT(refusal([] { kernel_by_name("gaus2"); }, ExitCode::Usage),
              ::testing::HasSubstr("did you mean 'gauss2'?"));
  for (const Shape& bad :
       {Shape{0.09, 2}, Shape{20.1, 2}, Shape{2, 0.4}, Shape{2, 8.1}, Shape{NAN, 2}, Shape{2, NAN}}) {
    refusal([&] { Kernel(bad.a, bad.radius); }, ExitCode::Usage);
  }
}

}  // namespace
}  // namespace fastsplat::scene
