// SPDX-License-Identifier: Apache-2.0
// Errors of 3-D Gaussians: shares add up, a narrower word is blamed, and a pixel's story names Gaussians of the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/error_values.hpp"
#include "analysis/errors/attribution.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "analysis/errors/pixel_report.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Chain;

scene::GaussianScene shells() {
  scene::GaussianDescription description;
  description.width = 72, description.height = 60;
  description.up = scene::UpAxis::Z;
  return scene::build_gaussian_scene(
      description, std::make_shared<scene::GaussianCloud>(scene::make_synthetic_gaussians("shells:400")));
}

cmodel::Config usual_config() {
  cmodel::Config config = test::named_config("ellipse");
  config.composite_every_sample = 1;
  config.freeze_below = 7;
  return config;
}

const StepError& largest(const Attribution& a) {
  return *std::ranges::max_element(a.steps, {}, [](const StepError& step) { return step.share; });
}

TEST(GaussianErrors, SharesAddUpAndNameTheNarrowWord) {
  const scene::GaussianScene scene = shells();
  cmodel::Config narrow = usual_config();
  narrow.sheet_frac_bits = 8;
  for (const auto& [config, blamed] : {std::pair{usual_config(), ""}, {narrow, "product"}}) {
    const Attribution a = attribute(Chain(scene, config), {.threads = 2});
    double sum = 0.0;
    for (const StepError& step : a.steps) sum += step.share;
    std::printf("[figure] RMS %.5f LSB8, largest share: %s %.1f %%, sum of shares = %.12f (limit 1 +- 1e-9)\n",
                a.total.rms * lsb_per_unit(8), largest(a).set.name.c_str(), 100.0 * largest(a).share, sum);
    EXPECT_NEAR(sum, 1.0, 1e-9);
    EXPECT_GT(a.total.rms, 0.0);
    if (*blamed != '\0') {
      EXPECT_EQ(largest(a).set.name, blamed);
    }
  }
}

// The places of ellipses are not snapped: phases would not help.
TEST(GaussianErrors, TheHintIsAFinerPosition) {
  const scene::GaussianScene scene = shells();
  cmodel::Config config = usual_config();
  config.radial_entries = 4096;
  const auto chain_of = [&](const cmodel::Config& other) { return std::make_unique<Chain>(scene, other, 2); };
  const Attribution a = attribute(*chain_of(config), {.quick = true, .threads = 2});
  const auto tried = try_suggestion(chain_of, config, a, true, 2);
  ASSERT_TRUE(tried);
  std::printf("[figure] %s of %s: RMS %.5f -> %.5f LSB8 (limit: less)\n", tried->suggestion.changes.c_str(),
              tried->step.c_str(), a.total.rms * lsb_per_unit(8), tried->error.rms * lsb_per_unit(8));
  EXPECT_EQ(tried->suggestion.changes, "position.frac_bits 8 -> 9");
  EXPECT_LT(tried->error.rms, a.total.rms);
}

TEST(GaussianErrors, APixelsStoryAddsUpAndNamesGaussiansOfTheFile) {
  const scene::GaussianScene scene = shells();
  const cmodel::Config config = usual_config();
  const Chain chain(scene, config);
  const PixelReport report = explain(chain, 36, 30, 1);
  golden::Sums sum{};
  for (const PixelPart& part : report.parts)
    for (std::size_t c = 0; c < 4; ++c) sum[c] += part.error[c];
  const auto json = to_json(report, chain);
  std::printf("[figure] Gaussians at the pixel = %zu (limit > 3)\n", json["splats"].size());
  EXPECT_GT(json["splats"].size(), 3u);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(sum[c], report.error()[c], 1e-12);
  // Each is nearer than the next, and its weight is exp(-q/2) of its own footprint.
  double depth = -1e9;
  for (const auto& splat : json["splats"]) {
    const auto number = splat["gaussian"].get<std::uint32_t>();
    scene::ProjectedGaussian projected;
    ASSERT_TRUE(scene::project(scene, number, projected));
    EXPECT_GE(projected.depth, depth);
    depth = projected.depth;
    const double weight = splat["values"]["weight"]["real"].get<double>();
    EXPECT_NEAR(weight, std::exp(-0.5 * projected.q(36.0 - projected.x, 30.0 - projected.y)), 1e-12);
  }
  EXPECT_NE(to_text(report, chain, {}, 8).find("pixel 36,30"), std::string::npos);
}

}  // namespace
}  // namespace fastsplat::analysis
