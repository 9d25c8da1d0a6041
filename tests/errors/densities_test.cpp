// SPDX-License-Identifier: Apache-2.0
// Attribution of frames whose sheets are densities: parts that add up, steps that all occur, and the fix of one.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "analysis/error_values.hpp"
#include "analysis/errors/attribution.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Chain, stages::Picture;

cmodel::Config with_densities(const std::string& name, int segment_bits = 9) {
  cmodel::Config config = test::named_config(name);
  config.classify_segment_bits = segment_bits;
  return config;
}

const StepError& step(const Attribution& a, const std::string& name) {
  for (const StepError& one : a.steps) {
    if (one.set.name == name) return one;
  }
  throw std::runtime_error("no step " + name);
}

TEST(DensityErrors, PartsAddUpToTheErrorAtEveryPixel) {
  double worst_sum = 0.0, worst_pixel = 0.0;
  std::uint64_t values = 0;
  for (const char* name : {"base", "fine", "tiny"}) {
    for (const auto& description : stages::test::small_density_scenes()) {
      const scene::Scene scene = scene::build_scene(description);
      const cmodel::Config config = with_densities(name, 6);
      const Chain chain(scene, config);
      const Attribution a = attribute(chain, {.quick = true, .threads = 1});
      ASSERT_GT(a.total.rms, 0.0);
      double sum = 0.0;
      for (const StepError& one : a.steps) sum += one.share;
      worst_sum = std::max(worst_sum, std::abs(sum - 1.0));
      for (std::size_t i = 0; i < a.real.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
          double parts = 0.0;
          for (const Picture& part : a.increments) parts += part.pixels[i][c];
          worst_pixel = std::max(worst_pixel, std::abs(parts - (a.device.pixels[i][c] - a.real.pixels[i][c])));
          ++values;
        }
      }
    }
  }
  std::printf("[figure] %llu values: shares off 1 by at most %.2g, a pixel's parts off its error by %.2g\n",
              static_cast<unsigned long long>(values), worst_sum, worst_pixel);
  EXPECT_GT(values, 10000u);
  // Thousands of products of doubles are summed; the largest are of the sum's own size.
  EXPECT_LT(worst_sum, 1e-9);
  EXPECT_LT(worst_pixel, 1e-12);
}

TEST(DensityErrors, SixGroupsAddUp) {
  const scene::Scene scene = scene::build_scene(stages::test::small_density_scenes().front());
  const cmodel::Config config = with_densities("base");
  const Chain chain(scene, config);
  const Attribution a = attribute(chain, {.quick = true, .shapley = true, .threads = 1});
  double sum = 0.0;
  std::string names;
  for (const GroupShare& group : a.groups) sum += group.share, names += group.name + " ";
  std::printf("[figure] groups %sadd up to 1 %+.2g, %d frames\n", names.c_str(), sum - 1.0, a.chains);
  EXPECT_EQ(names, "place material footprint sheets classification picture ");
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_EQ(a.chains, 1 + static_cast<int>(a.steps.size()) + 62);
}

TEST(DensityErrors, EveryStepOfThePixelErrsAlone) {
  scene::Scene scene = scene::build_scene(stages::test::small_density_scenes().front());
  scene.shading.gradient_floor = 0.1;  // chosen so that many pixels are between it and twice that
  const cmodel::Config config = with_densities("base");
  const Chain chain(scene, config);
  // The difference of golden's floats after the gradient from the others' doubles
  // (tests/pipeline/density_steps_test.cpp).
  const double floats = 1e-5 / lsb_per_unit(8);
  const Attribution a = attribute(chain, {.threads = 1});
  int steps = 0;
  for (const StepError& one : a.steps) {
    if (!stages::of_densities(one.set.steps.front())) continue;
    std::printf("[figure] %s alone: RMS %.5f LSB8\n", one.set.name.c_str(), one.only.rms * lsb_per_unit(8));
    EXPECT_GT(one.only.rms, floats) << one.set.name;
    EXPECT_STREQ(one.set.by, "device");
    ++steps;
  }
  EXPECT_EQ(steps, 8);
}

TEST(DensityErrors, SegmentsOfTheTransferFunctionMendIt) {
  const scene::Scene scene = scene::build_scene(stages::test::small_density_scenes().front());
  const cmodel::Config config = with_densities("fine", 3);
  const Chain chain(scene, config);
  const Attribution a = attribute(chain, {.quick = true, .threads = 1});
  const auto tried = try_suggestion([&](const cmodel::Config& other) { return std::make_unique<Chain>(scene, other); },
                                    config, a, false, 1);
  ASSERT_TRUE(tried);
  std::printf("[figure] 8 segments: transfer %.1f %% of RMS %.3f LSB8; %s: RMS %.3f\n",
              100.0 * step(a, "transfer").share, a.total.rms * lsb_per_unit(8), tried->suggestion.changes.c_str(),
              tried->error.rms * lsb_per_unit(8));
  EXPECT_GT(step(a, "transfer").share, 0.8);
  EXPECT_EQ(tried->step, "transfer");
  EXPECT_EQ(tried->suggestion.changes, "classify.segment_bits 3 -> 5");
  EXPECT_LT(tried->error.rms, 0.5 * a.total.rms);
}

}  // namespace
}  // namespace fastsplat::analysis
