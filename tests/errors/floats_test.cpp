// SPDX-License-Identifier: Apache-2.0
// Attribution of floats: shares add up, each step is one that floats round, and sums of their own format help an X-ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/errors/attribution.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Chain, stages::float_format, stages::Step;

scene::Scene shells(scene::Method method) {
  scene::SceneDescription description;
  description.volume = "shells:64";
  description.width = description.height = 32;
  description.method = method;
  return scene::build_scene(description);
}

Attribution attributed(const Chain& chain, const char* sums) {
  return attribute(
      chain, {.quick = true,
              .floats = stages::FloatNumbers{.operands = float_format("fp16", ""), .sums = float_format(sums, "")},
              .threads = 1});
}

TEST(FloatErrors, SharesAddUpAndStepsAreThoseThatFloatsRound) {
  // X-rays of `base` diffuse errors: emission and product of integers are one step there.
  for (const auto method : {scene::Method::ImageAligned, scene::Method::XRay}) {
    const scene::Scene scene = shells(method);
    const cmodel::Config config = test::named_config("base");
    const Chain chain(scene, config);
    EXPECT_EQ(chain.carries(), method == scene::Method::XRay);
    const Attribution a = attributed(chain, "fp16");
    double sum = 0.0;
    for (const StepError& step : a.steps) {
      sum += step.share;
      EXPECT_STREQ(step.set.by, "float");
      EXPECT_EQ(step.set.steps.size(), 1u) << step.set.name;
      for (const Step none : {Step::Snap, Step::Index, Step::Freeze})
        EXPECT_EQ(std::ranges::count(step.set.steps, none), 0) << step.set.name;
    }
    std::printf("[figure] %zu steps, sum of shares = %.12f (limit 1 +- 1e-9)\n", a.steps.size(), sum);
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

TEST(FloatErrors, WiderSumsHelpAnXRay) {
  const scene::Scene scene = shells(scene::Method::XRay);
  const cmodel::Config config = test::named_config("base");
  const Chain chain(scene, config);
  const double narrow = attributed(chain, "bf16").total.rms, wide = attributed(chain, "fp32").total.rms;
  std::printf("[figure] RMS with sums in bf16 over that in fp32: %.1f (limit > 1.5)\n", narrow / wide);
  EXPECT_GT(narrow, 1.5 * wide);
}

}  // namespace
}  // namespace fastsplat::analysis
