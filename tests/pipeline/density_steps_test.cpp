// SPDX-License-Identifier: Apache-2.0
// The steps of a density pixel alone: their device side equals the integer model's unit on any words, their real side
// equals golden's stage.
#include "analysis/pipeline/density_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cmodel/classify/classify_unit.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tiles/compile.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::stages {
namespace {

using fastsplat::test::Random, fastsplat::test::random_density_config, fastsplat::test::seed_or;
using test::random_density_scene, test::text_of;

/// Often an end of the range, often near 0.
std::int64_t word_between(Random& random, std::int64_t low, std::int64_t high) {
  switch (random.between(0, 5)) {
    case 0:
      return random.one_of({low, high});
    case 1:
      return std::clamp<std::int64_t>(random.between(-3, 3), low, high);
    case 2:
      return random.between(low / 64, high / 64);
    default:
      return random.between(low, high);
  }
}

TEST(DensitySteps, TheDevicesSideIsTheModelsUnitOnAnyWords) {
  Random random(seed_or(2120));
  std::uint64_t words = 0, different = 0, seen = 0, shaded = 0;
  for (int scenes = 0; scenes < 60; ++scenes) {
    const cmodel::Config config = random_density_config(random);
    scene::SceneDescription description = random_density_scene(random);
    description.shading = random.once_in(4) ? 0 : 1;
    const scene::Scene scene = scene::build_scene(description);
    const scene::SlabGrid slabs = driver::plan_for_device(scene).slabs;
    scene::Scene unlit = scene;
    unlit.shading.on = false;
    const DensitySteps steps(scene, config, slabs), plain(unlit, config, slabs);
    cmodel::ClassifyUnit unit(config);
    for (const cmodel::LoadTable& table : driver::density_tables(config, scene, slabs))
      unit.load(table.table, table.words);
    const std::int64_t most = config.sheet_format().max;
    const double ulp = std::ldexp(1.0, -config.sheet_frac_bits);
    for (int pixel = 0; pixel < 300; ++pixel) {
      const std::int64_t density = word_between(random, 0, most);
      const cmodel::DensitySlope slope{.x = word_between(random, -2 * most, 2 * most),
                                       .y = word_between(random, -2 * most, 2 * most),
                                       .z = word_between(random, -most, most)};
      const DensityPixel at{.density = static_cast<double>(density) * ulp,
                            .across = {static_cast<double>(slope.x) * ulp, static_cast<double>(slope.y) * ulp,
                                       static_cast<double>(slope.z) * ulp},
                            .x = static_cast<int>(random.between(0, 4095)),
                            .y = static_cast<int>(random.between(0, 4095)),
                            .sheet = static_cast<int>(random.between(0, slabs.count - 1))};
      const cmodel::SheetWord expected =
          unit(static_cast<std::uint32_t>(density), slope, at.x, at.y, static_cast<std::uint32_t>(at.sheet));
      const golden::Sums sums = steps(at, Mixture::all_device());
      shaded += sums != plain(at, Mixture::all_device()) ? 1 : 0;
      seen += expected[3] != 0 ? 1 : 0;
      for (std::size_t c = 0; c < 4; ++c) {
        const bool same = sums[c] == static_cast<double>(expected[c]) * ulp;
        different += same ? 0 : 1;
        ++words;
        ASSERT_TRUE(same) << text_of(config) << "\n"
                          << scene::to_toml(description) << "channel " << c << " of density " << density << ", slope "
                          << slope.x << " " << slope.y << " " << slope.z << ": " << sums[c] / ulp << " for "
                          << expected[c];
      }
    }
  }
  std::printf(
      "[figure] %llu words, %llu pixels with something to be seen, %llu with a share of shading, %llu "
      "different\n",
      static_cast<unsigned long long>(words), static_cast<unsigned long long>(seen),
      static_cast<unsigned long long>(shaded), static_cast<unsigned long long>(different));
  EXPECT_GT(seen, words / 4 / 4);
  EXPECT_GT(shaded, 200u);
}

/// In some scenes the volume is a CT, whose values spread from that of air on.
TEST(DensitySteps, TheRealSideIsGoldensStage) {
  Random random(seed_or(2121));
  const cmodel::Config config = fastsplat::test::named_config("base");
  const auto with_densities = [&] {
    cmodel::Config out = config;
    out.classify_segment_bits = 9;
    return out;
  }();
  std::uint64_t values = 0, seen = 0, over = 0;
  double worst = 0.0;
  for (int scenes = 0; scenes < 30; ++scenes) {
    scene::SceneDescription description = random_density_scene(random);
    description.shading = scenes % 3 == 0 ? 0 : 1;
    scene::Scene scene = scene::build_scene(description);
    if (random.once_in(2)) {
      auto scan = std::make_shared<volume::Volume>(*scene.volume);
      scan->water = 1000.0 + scan->min + 0.4 * (scan->max - scan->min);
      scene.volume = scan;
    }
    const scene::SlabGrid slabs = driver::plan_for_device(scene).slabs;
    const DensitySteps steps(scene, with_densities, slabs);
    const int width = description.width, height = description.height;
    const double range =
        (static_cast<double>(scene.volume->max) - scene.volume->min) * description.slab_width;  // golden's 1.0
    const golden::Rows rows{0, height};
    std::vector<golden::Sheet> sheets(3, golden::Sheet(rows, width));
    const double reach = std::exp2(-static_cast<double>(random.between(0, 9)));  // flat fields, too
    for (golden::Sheet& sheet : sheets) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
          sheet.row(y)[x][3] = range * (0.3 + reach * static_cast<double>(random.between(0, 1 << 20)) / (1 << 20));
      }
    }
    const int number = static_cast<int>(random.between(0, slabs.count - 1));
    const golden::SheetWindow window{number, sheets[0], sheets[1], sheets[2]};
    const double bound = steps.golden_error();
    for (int y = 0; y < height; ++y) {
      std::vector<golden::Sums> expected(static_cast<std::size_t>(width));
      steps.golden_row(window, y, 0, expected);
      const auto part = [&](std::size_t sheet, int i, int j) { return sheets[sheet].row(j)[i][3] / range; };
      for (int x = 0; x < width; ++x) {
        const int left = std::max(x - 1, 0), right = std::min(x + 1, width - 1), above = std::max(y - 1, 0),
                  below = std::min(y + 1, height - 1);
        const golden::Sums sums = steps({.density = part(1, x, y),
                                         .across = {(part(1, right, y) - part(1, left, y)) * (2.0 / (right - left)),
                                                    (part(1, x, below) - part(1, x, above)) * (2.0 / (below - above)),
                                                    part(2, x, y) - part(0, x, y)},
                                         .x = x,
                                         .y = y,
                                         .sheet = number},
                                        Mixture{});
        const golden::Sums& golden = expected[static_cast<std::size_t>(x)];
        seen += golden[3] > 0.0 ? 1 : 0;
        for (std::size_t c = 0; c < 4; ++c) {
          const double apart = std::abs(sums[c] - golden[c]) / std::max(golden[3], 1e-30);
          worst = std::max(worst, apart / bound);
          over += apart <= bound ? 0 : 1;
          ++values;
        }
      }
    }
    EXPECT_EQ(over, 0u) << scene::to_toml(description);
  }
  std::printf(
      "[figure] %llu values, %llu pixels with something to be seen, %llu beyond what floats explain, at most "
      "%.2f of it\n",
      static_cast<unsigned long long>(values), static_cast<unsigned long long>(seen),
      static_cast<unsigned long long>(over), worst);
  EXPECT_GT(seen, values / 4 / 4);
}

}  // namespace
}  // namespace fastsplat::stages
