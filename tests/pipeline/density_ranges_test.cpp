// SPDX-License-Identifier: Apache-2.0
// The ranges of a density pixel: no pixel within its inputs' ranges leaves them, on any side of any step.
#include "analysis/pipeline/density_ranges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "driver/tiles/compile.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::stages {
namespace {

using fastsplat::test::Random, fastsplat::test::random_density_config, fastsplat::test::seed_or;
using test::random_density_scene, test::random_mixture, test::text_of;

double between(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.between(0, 1 << 30)) / (1 << 30);
}
/// Often an end.
double inside(Random& random, const Range& range) {
  return random.once_in(3) ? random.one_of({0, 1}) == 0 ? range.low : range.high
                           : between(random, range.low, range.high);
}

TEST(DensityRanges, HoldEveryPixelWithinTheRangesOfItsInputs) {
  Random random(seed_or(2130));
  std::uint64_t pixels = 0, seen = 0, values = 0, outside = 0;
  double wide = 0.0, used = 0.0;
  for (int scenes = 0; scenes < 150; ++scenes) {
    const cmodel::Config config = random_density_config(random);
    scene::SceneDescription description = random_density_scene(random);
    description.shading = random.once_in(4) ? 0 : 1;
    const scene::Scene scene = scene::build_scene(description);
    const scene::SlabGrid slabs = driver::plan_for_device(scene).slabs;
    const DensitySteps steps(scene, config, slabs);
    const Mixture mixture = random.once_in(2) ? Mixture::all_device() : random_mixture(random, true);
    const DensityRanges ranges(steps, mixture);
    for (int pixel = 0; pixel < 100; ++pixel) {
      const double by = random.once_in(4) ? 0.0 : std::exp2(-between(random, 2.0, 14.0));
      const auto range = [&](double low, double high) {
        const double at = between(random, low, high);
        return Range{std::max(low, at - by * between(random, 0.0, 1.0)), at + by * between(random, 0.0, 1.0)};
      };
      const double slope = std::exp2(-between(random, 0.0, 8.0));
      const DensityRange of{.density = range(0.0, 1.2),
                            .across = {range(-slope, slope), range(-slope, slope), range(-slope, slope)},
                            .x = static_cast<int>(random.between(0, 100)),
                            .y = static_cast<int>(random.between(0, 100)),
                            .sheet = static_cast<int>(random.between(0, slabs.count - 1))};
      const ClassifiedRange out = ranges(of);
      Range taken = {out.colour[0].high, out.colour[0].low};
      for (int one = 0; one < 40; ++one) {
        const golden::Sums sums =
            steps({.density = inside(random, of.density),
                   .across = {inside(random, of.across[0]), inside(random, of.across[1]), inside(random, of.across[2])},
                   .x = of.x,
                   .y = of.y,
                   .sheet = of.sheet},
                  mixture);
        const double tau = sums[3];
        bool holds = out.tau.low <= tau && tau <= out.tau.high;
        for (std::size_t c = 0; tau > 0.0 && c < 3; ++c) {
          holds &= sums[c] >= std::min(out.colour[c].low * tau - out.rounded, out.largest) &&
                   sums[c] <= std::min(out.colour[c].high * tau + out.rounded, out.largest);
          ++values;
        }
        if (tau > 0.0) {
          taken.low = std::min(taken.low, sums[0] / tau);
          taken.high = std::max(taken.high, sums[0] / tau);
          ++seen;
        }
        outside += holds ? 0 : 1;
        ASSERT_TRUE(holds) << text_of(config) << "\n"
                           << scene::to_toml(description) << mixture.text() << ": tau " << tau << " in " << out.tau.low
                           << ".." << out.tau.high << ", red " << sums[0] / tau << " in " << out.colour[0].low << ".."
                           << out.colour[0].high << " by " << out.rounded / tau << ", " << sums[1] / tau << " "
                           << sums[2] / tau;
      }
      if (by > 0.0 && out.tau.low > 0.0) {
        wide += out.colour[0].high - out.colour[0].low;
        used += std::max(0.0, taken.high - taken.low);
      }
      ++pixels;
    }
  }
  std::printf(
      "[figure] %llu ranges, %llu pixels within them that show something, %llu values, %llu outside (limit 0)\n",
      static_cast<unsigned long long>(pixels), static_cast<unsigned long long>(seen),
      static_cast<unsigned long long>(values), static_cast<unsigned long long>(outside));
  std::printf("[figure] of a colour's range 40 pixels take %.0f %% (limit > 50)\n", 100.0 * used / wide);
  EXPECT_GT(seen, 100000u);
  EXPECT_GT(used, 0.5 * wide);
}

}  // namespace
}  // namespace fastsplat::stages
