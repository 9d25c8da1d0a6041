// SPDX-License-Identifier: Apache-2.0
// Shares that add up, and cases with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "analysis/error_values.hpp"
#include "analysis/errors/attribution.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "base/error.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Chain, stages::Mixture, stages::Picture;

scene::SceneDescription view_of(const std::string& volume, int size) {
  scene::SceneDescription description;
  description.volume = volume;
  description.width = description.height = size;
  return description;
}

/// A scan of a package that may be missing.
std::shared_ptr<const volume::Volume> scan(const std::string& name) {
  try {
    return std::make_shared<const volume::Volume>(volume::load_volume(name));
  } catch (const UserError&) {
    return nullptr;
  }
}

Attribution attributed(const scene::SceneDescription& description, const cmodel::Config& config) {
  const scene::Scene scene = scene::build_scene(description);
  const Chain chain(scene, config);
  return attribute(chain, {.quick = true, .threads = 2});
}

const StepError& step(const Attribution& a, const std::string& name) {
  for (const StepError& one : a.steps) {
    if (one.set.name == name) return one;
  }
  throw std::runtime_error("no step " + name);
}

/// Error of the whole device, LSB8.
Amount error_of(const scene::Scene& scene, const cmodel::Config& config) {
  const Chain chain(scene, config);
  Amount out = amount_of(difference(chain(Mixture::all_device(), 2), chain(Mixture{}, 2)));
  out.rms *= lsb_per_unit(8), out.greatest *= lsb_per_unit(8), out.bias *= lsb_per_unit(8);
  return out;
}

TEST(Attribution, AddsUpToTheErrorAtEveryPixel) {
  test::Random random(test::seed_or(3200));
  int scenes = 0;
  double worst_sum = 0.0, worst_groups = 0.0, worst_pixel = 0.0;
  while (scenes < 6) {
    const cmodel::Config config = test::random_config(random);
    const scene::Scene scene = scene::build_scene(stages::test::random_scene(random));
    try {
      const Chain chain(scene, config);
      const Attribution a = attribute(chain, {.shapley = true, .threads = 2});
      if (a.total.rms == 0.0) continue;
      double sum = 0.0, groups = 0.0;
      for (const StepError& one : a.steps) sum += one.share;
      for (const GroupShare& one : a.groups) groups += one.share;
      EXPECT_NEAR(a.driver_share + a.device_share + a.both_share, sum, 1e-9);
      worst_sum = std::max(worst_sum, std::abs(sum - 1.0));
      worst_groups = std::max(worst_groups, std::abs(groups - 1.0));
      for (std::size_t i = 0; i < a.real.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
          double parts = 0.0;
          for (const Picture& part : a.increments) parts += part.pixels[i][c];
          worst_pixel = std::max(worst_pixel, std::abs(parts - (a.device.pixels[i][c] - a.real.pixels[i][c])));
        }
      }
      ++scenes;
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
  std::printf(
      "[figure] %d scenes: shares off 1 by at most %.2g, groups by %.2g, a pixel's parts off its error by %.2g\n",
      scenes, worst_sum, worst_groups, worst_pixel);
  // Hundreds of thousands of products of doubles are summed; the largest are of the sum's own size.
  EXPECT_LT(worst_sum, 1e-9);
  EXPECT_LT(worst_groups, 1e-9);
  EXPECT_LT(worst_pixel, 1e-12);
}

TEST(Attribution, AHeadIsRuledByPositionAndFreezeAndItsBiasByFreeze) {
  const auto head = scan("ch2bet");
  if (!head) GTEST_SKIP() << "the scan is not installed";
  scene::SceneDescription description = view_of("ch2bet", 128);
  description.transfer_function = "mri-head";
  const scene::Scene scene = scene::build_scene(description, head);
  const cmodel::Config config = test::named_config("base");
  const Attribution a = attribute(Chain(scene, config), {.quick = true, .threads = 2});
  const StepError &place = step(a, "position+snap"), &freeze = step(a, "freeze");
  std::printf(
      "[figure] ch2bet 128 base: RMS %.4f LSB8, position+snap %.1f %%, freeze %.1f %%, bias %.4f, of freeze %.4f\n",
      a.total.rms * lsb_per_unit(8), 100.0 * place.share, 100.0 * freeze.share, a.total.bias * lsb_per_unit(8),
      freeze.increment.bias * lsb_per_unit(8));
  EXPECT_GT(place.share + freeze.share, 0.9);
  EXPECT_GT(freeze.increment.bias / a.total.bias, 0.9);
  EXPECT_EQ(a.blame.size(), a.increments.front().pixels.size());
  ASSERT_EQ(a.stories.size(), 3u);
  EXPECT_NEAR(std::abs(a.stories.back().error), a.total.greatest, 1e-12);
}

TEST(Attribution, DensitiesOfAHeadAreRuledByPositionAndThePixelStageIsNothing) {
  const auto head = scan("ch2bet");
  if (!head) GTEST_SKIP() << "the scan is not installed";
  scene::SceneDescription description = view_of("ch2bet", 128);
  description.transfer_function = "mri-head";
  description.classify = scene::ClassifyOrder::Post;
  const scene::Scene scene = scene::build_scene(description, head);
  cmodel::Config config = test::named_config("fine");
  config.classify_segment_bits = 9;
  const Attribution a = attribute(Chain(scene, config), {.quick = true, .threads = 2});
  double classified = 0.0;
  for (const StepError& one : a.steps) {
    if (stages::of_densities(one.set.steps.front())) classified += one.share;
  }
  std::printf("[figure] ch2bet 128 fine, densities: RMS %.4f LSB8, position+snap %.1f %%, transfer to colour %.2f %%\n",
              a.total.rms * lsb_per_unit(8), 100.0 * step(a, "position+snap").share, 100.0 * classified);
  EXPECT_GT(step(a, "position+snap").share, 0.7);
  EXPECT_LT(std::abs(classified), 0.05);
}

TEST(Attribution, CompactIsRuledByItsEightPhases) {
  const Attribution a = attributed(view_of("shells:32", 64), test::named_config("compact"));
  std::printf("[figure] shells:32 64 compact: position+snap %.1f %%\n", 100.0 * step(a, "position+snap").share);
  EXPECT_GT(step(a, "position+snap").share, 0.8);
}

TEST(Attribution, AnXrayOnTinyIsRuledByTheEmissionWord) {
  scene::SceneDescription description = view_of("shells:32", 64);
  description.method = scene::Method::XRay;
  cmodel::Config config = test::named_config("tiny");
  config.rounding_carry = static_cast<int>(cmodel::Carry::Off);
  const Attribution a = attributed(description, config);
  config.rounding_carry = static_cast<int>(cmodel::Carry::XRay);
  const Attribution carried = attributed(description, config);
  std::printf("[figure] shells:32 64 tiny, X-ray: emission %.1f %% of RMS %.3f; with the carry RMS %.3f LSB8\n",
              100.0 * step(a, "emission").share, a.total.rms * lsb_per_unit(8), carried.total.rms * lsb_per_unit(8));
  EXPECT_GT(step(a, "emission").share, 0.5);
  EXPECT_LT(carried.total.rms, a.total.rms);
  EXPECT_THROW(step(carried, "emission"), std::runtime_error);  // with the carry it is one with product
  EXPECT_NO_THROW(step(carried, "emission+product"));
}

TEST(Attribution, ASparseScanZoomedOutIsRuledBySnappingAndPhasesMendIt) {
  const auto brain = scan("inia19-t1-brain");
  if (!brain) GTEST_SKIP() << "the scan is not installed";
  const scene::Scene scene = scene::build_scene(view_of("inia19-t1-brain", 64), brain);
  cmodel::Config config = test::named_config("base");
  const Attribution a = attribute(Chain(scene, config), {.quick = true, .threads = 2});
  const Amount coarse = error_of(scene, config);
  config.phases = 512;
  config.position_frac_bits = 9;
  const Amount fine = error_of(scene, config);
  std::printf(
      "[figure] inia19 64 base: snapping %.1f %%; max %.2f LSB8 with 64 phases, %.2f with 512; RMS %.4f, %.4f\n",
      100.0 * step(a, "position+snap").share, coarse.greatest, fine.greatest, coarse.rms, fine.rms);
  EXPECT_GT(step(a, "position+snap").share, 0.8);
  EXPECT_GT(coarse.greatest, 4.0 * fine.greatest);
}

TEST(Attribution, RadialEntriesMatterUpTo256) {
  const scene::Scene scene = scene::build_scene(view_of("shells:32", 64));
  double rms[3]{};
  const int entries[] = {64, 256, 1024};
  for (int i = 0; i < 3; ++i) {
    cmodel::Config config = test::named_config("base");
    config.radial_entries = entries[i];
    rms[i] = error_of(scene, config).rms;
  }
  std::printf("[figure] shells:32 64 base: RMS %.4f, %.4f, %.4f LSB8 with 64, 256, 1024 entries\n", rms[0], rms[1],
              rms[2]);
  EXPECT_GT(rms[0] / rms[1], 1.5);
  EXPECT_LT(rms[1] / rms[2], 1.5);
}

TEST(Attribution, WhereNothingIsWrongItSaysSo) {
  scene::SceneDescription description = view_of("shells:8", 8);
  description.opacity_scale = 1e-6;
  const Attribution a = attributed(description, test::named_config("exact"));
  // Too faint for any word: the device shows nothing, golden almost nothing.
  const std::string text = to_text(a, std::nullopt, 8);
  std::printf("[figure] faint shells: RMS %.3g LSB8\n", a.total.rms * lsb_per_unit(8));
  EXPECT_LT(a.total.rms * lsb_per_unit(8), 1e-3);
  EXPECT_NE(text.find("sum 100.0 %"), std::string::npos) << text;
}

}  // namespace
}  // namespace fastsplat::analysis
