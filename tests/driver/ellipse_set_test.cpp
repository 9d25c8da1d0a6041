// SPDX-License-Identifier: Apache-2.0
// Ellipses as words of squared_elliptic (docs/numerics.md, section 4.3), against the ellipse in reals.
#include "driver/tables/ellipse_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cmodel/numbers/index_set.hpp"
#include "cmodel/splat/quadric.hpp"
#include "cmodel/splat/squared_unit.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tables/index_tables.hpp"
#include "tests/cmodel/random_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

cmodel::Config elliptic(int entries) {
  auto config = load_config("base");
  config.index_kind = static_cast<int>(cmodel::IndexKind::SquaredElliptic);
  config.phases = 1;
  config.radial_entries = entries;
  return config;
}

double unit(test::Random& random) { return static_cast<double>(random.next() >> 11) * 0x1p-53; }

/// Half axes and the angle of the long one.
struct Axes {
  double longer = 0.0, shorter = 0.0, angle = 0.0;
  EllipseRim rim() const {
    const double c = std::cos(angle), s = std::sin(angle), l = longer * longer, m = shorter * shorter;
    return {.xx = l * c * c + m * s * s, .xy = (l - m) * c * s, .yy = l * s * s + m * c * c};
  }
  /// 1 on the rim.
  double at(double x, double y) const {
    const double along = x * std::cos(angle) + y * std::sin(angle), across = y * std::cos(angle) - x * std::sin(angle);
    return along * along / (longer * longer) + across * across / (shorter * shorter);
  }
};
/// Long half axes up to 32 pixels, short ones at most `aspect` times shorter.
Axes random_axes(test::Random& random, double aspect) {
  Axes axes{.longer = 32.0 * std::pow(2.0, -4.0 * unit(random)),
            .shorter = 0.0,
            .angle = 2.0 * std::numbers::pi * unit(random)};
  axes.shorter = axes.longer * std::pow(aspect, -unit(random));
  return axes;
}

// q by the words is never negative, and inside the rim its error is below the page's bound.
TEST(EllipseSets, QIsTheEllipsesToWithinTheBound) {
  test::Random random(test::seed_or(81));
  double worst = 0.0, entries_off = 0.0;
  std::uint64_t inside = 0, pixels = 0;
  for (const int entries : {64, 1024, 2048}) {
    const auto config = elliptic(entries);
    const double K = config.grid();
    for (int n = 0; n < 300; ++n) {
      const Axes axes = random_axes(random, 16.0);
      const auto table = ellipse_table(config, 0, axes.rim());
      ASSERT_FALSE(cmodel::set_violation(config, table.words));
      const cmodel::Quadric f = cmodel::quadric_of(table.words);
      const double ratio = axes.longer / axes.shorter, limit = 1.5 * entries * ratio * ratio * 0x1p-23;
      const std::int64_t ox = random.between(0, 63), oy = random.between(0, 63), reach = table.radius.rho + 64;
      EXPECT_GE(table.radius.rho, K * std::sqrt(std::max(axes.rim().xx, axes.rim().yy)));  // N-4.3-7
      for (std::int64_t dy = oy - reach; dy <= reach; dy += 64)
        for (std::int64_t dx = ox - reach; dx <= reach; dx += 64, ++pixels) {
          const std::int64_t q = cmodel::quadric(f, dx, dy);
          ASSERT_GE(q, 0);
          const double exact = axes.at(static_cast<double>(dx) / K, static_cast<double>(dy) / K);
          if (exact > 1.0) continue;
          ++inside;
          const double off = std::abs(std::ldexp(static_cast<double>(q), -f.shift) - exact * entries);
          entries_off = std::max(entries_off, off);
          worst = std::max(worst, off / limit);
          ASSERT_LT(off, limit + 1e-9 * entries) << "axes " << axes.longer << " x " << axes.shorter;
        }
    }
  }
  figure("pixels", static_cast<double>(pixels));
  figure("inside the rim", static_cast<double>(inside));
  figure("worst, of the bound (limit 1)", worst);
  figure("worst", entries_off, "entries");
  EXPECT_GT(inside, 100000U);
  EXPECT_GT(worst, 0.25) << "the bound says nothing";
}

// N-4.3-7: h. The words' matrix has no eigenvalue below 0, up to the flattest ellipse that the page allows.
TEST(EllipseSets, TheFlattestAreStillEllipses) {
  test::Random random(test::seed_or(82));
  const auto config = elliptic(1024);
  int compared = 0;
  double least = 1e300;
  for (; compared < 20000; ++compared) {
    const Axes axes = random_axes(random, 1024.0);
    if (axes.shorter * config.grid() < 1.0) continue;
    const auto words = ellipse_table(config, 0, axes.rim()).words;
    ASSERT_FALSE(cmodel::set_violation(config, words)) << axes.longer << " x " << axes.shorter << " at " << axes.angle;
    const double a = words[0], b = static_cast<std::int32_t>(words[1]), c = words[2];
    least = std::min(least, (4.0 * a * c - b * b) / (4.0 * a * c));
    ASSERT_LE(std::max(words[0], words[2]), 1U << 24) << "cut";
    ASSERT_GE(std::max(words[0], words[2]), 1U << 23) << "bits given away";
  }
  figure("ellipses", compared);
  figure("flattest: (4AC - B^2) / 4AC (limit >= 0)", least);
}

// The circle's words are those of set_table, bit for bit (N-4.3-5).
TEST(EllipseSets, CirclesAreTheDriversOwn) {
  test::Random random(test::seed_or(83));
  const auto config = elliptic(1024);
  const auto kernel = scene::kernel_by_name("gauss2");
  int compared = 0;
  for (; compared < 5000; ++compared) {
    const double r = 0.5 + 60.0 * unit(random);
    const auto circle = set_table(config, kernel, 3, r, 0), ellipse = ellipse_table(config, 3, {r * r, 0.0, r * r});
    ASSERT_EQ(circle.words, ellipse.words) << r;
    ASSERT_NEAR(circle.radius.rho, ellipse.radius.rho, 1.0) << "sqrt(r r)";
    ASSERT_EQ(ellipse.radius.set, 3U);
  }
  figure("circles", compared);
}

// N-4.3-6: the reals; N-4.3-7: A and C up, B towards 0, each by less than 1.
TEST(EllipseSets, WordsAreRoundedOnceAndTheirWay) {
  test::Random random(test::seed_or(85));
  const auto config = elliptic(1024);
  int compared = 0;
  for (; compared < 5000; ++compared) {
    const EllipseRim rim = random_axes(random, 16.0).rim();
    const auto words = ellipse_table(config, 0, rim).words;
    const long double xx = rim.xx, xy = rim.xy, yy = rim.yy;
    const long double unit_word = std::ldexp(1024.0L, static_cast<int>(words[3])) / ((xx * yy - xy * xy) * 4096.0L);
    const long double a = yy * unit_word, c = xx * unit_word, b = -2.0L * xy * unit_word;
    // Of numbers of 24 bits in doubles, cancelled by 16^2: far below 2^-16.
    const long double slack = 0x1p-16L;
    const long double B = static_cast<std::int32_t>(words[1]);
    ASSERT_GE(words[0], a - slack);
    ASSERT_LT(words[0], a + 1.0L + slack);
    ASSERT_GE(words[2], c - slack);
    ASSERT_LT(words[2], c + 1.0L + slack);
    ASSERT_LE(std::abs(B), std::abs(b) + slack);
    ASSERT_GT(std::abs(B), std::abs(b) - 1.0L - slack);
    ASSERT_GE(B * b, 0.0L) << "sign";
  }
  figure("ellipses", compared);
}

// Mirrored ellipses differ in B's sign only: rounding it towards 0 favours no side.
TEST(EllipseSets, MirrorImagesHaveTheSameWords) {
  test::Random random(test::seed_or(84));
  const auto config = elliptic(1024);
  int compared = 0;
  for (; compared < 5000; ++compared) {
    EllipseRim rim = random_axes(random, 16.0).rim();
    const auto there = ellipse_table(config, 0, rim);
    rim.xy = -rim.xy;
    const auto back = ellipse_table(config, 0, rim);
    ASSERT_EQ(there.words[0], back.words[0]);
    ASSERT_EQ(static_cast<std::int32_t>(there.words[1]), -static_cast<std::int32_t>(back.words[1]));
    ASSERT_EQ(there.words[2], back.words[2]);
  }
  figure("mirror images", compared);
}

}  // namespace
}  // namespace fastsplat::driver
