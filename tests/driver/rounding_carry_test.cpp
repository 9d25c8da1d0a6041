// SPDX-License-Identifier: Apache-2.0
// Thin splats: what rounding takes of one goes to the next behind it (N-8-58 to N-8-61).
#include "driver/splats/rounding_carry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "driver/config/config_file.hpp"
#include "driver/splats/projection.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/sheet_plan.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using scene::Method;

cmodel::Config with_carry(const std::string& name, const char* carry) {
  auto config = load_config(name);
  EXPECT_FALSE(cmodel::set(config, "rounding.carry", carry));
  return config;
}

scene::SceneDescription view_by(Method method, const std::string& volume = "shells:32") {
  auto description = view_of(volume, 96);
  description.method = method;
  description.camera.azimuth = 20;
  return description;
}

std::vector<std::uint32_t> words_of(const scene::Scene& scene, const cmodel::Config& config, int threads = 1) {
  return render(scene, config, {.threads = threads, .progress = {}}).frame.words;
}

// N-8-59, N-8-60. A line's words, as the sheets show them, sum to its exact value except for the rest at its end. That
// is less than a word, plus the error of one word. The flat kernel in coarse sheets shows more than its value.
TEST(RoundingCarry, ALineShowsItsEnergy) {
  int lines = 0;
  double worst = 0.0, most_over = 0.0, most_under = 0.0;
  for (const auto& name : config_names()) {
    for (const int coarser : {0, 5}) {
      for (const scene::Kernel& kernel : {scene::kernel_by_name("gauss2"), scene::Kernel(0.1, 1.0)}) {
        auto config = load_config(name);
        config.sheet_frac_bits = std::max(4, config.sheet_frac_bits - coarser);
        const ShownWords shown(config, kernel);
        double under = 0.0, over = 0.0;
        for (int word = 0; word < 256; ++word) {
          under = std::max(under, word - shown(word));
          over = std::max(over, shown(word) - word);
        }
        most_under = std::max(most_under, under), most_over = std::max(most_over, over);
        const Target to = target(Site::Carried, config);
        for (const double step : {0.001, 0.3, 0.5, 0.99, 1.7, 20.25, 300.0}) {
          if (2.0 * step > static_cast<double>(to.to.max)) continue;  // more than a word has
          RoundingCarry carry(to, shown, 3, 7, 11);
          for (const std::uint32_t line : {33U, 40U, 76U}) {
            double asked = 0.0, got = 0.0;
            for (int i = 0; i < 500; ++i) {
              const double value = step * (1.0 + 0.9 * std::sin(i));
              asked += value;
              const Quantised word = carry(value / to.scale, carry.next(line, i), 2);
              ASSERT_FALSE(word.saturated) << name << " " << step;
              got += shown(word.word);
            }
            const double off = std::abs(got - asked) / (1.0 + std::max(under, over));
            worst = std::max(worst, off);
            EXPECT_LE(off, 1.0) << name << ", " << step << " words a splat: asked " << asked << ", shown " << got;
            ++lines;
          }
        }
      }
    }
  }
  figure("lines of 500 splats", lines);
  figure("a word is shown too short by up to", most_under, "words");
  figure("a word is shown too long by up to", most_over, "words");
  figure("largest difference, of what is allowed", worst);
  EXPECT_GT(most_over, 1.0) << "no line went below 0";
}

// N-8-58.
TEST(RoundingCarry, IsWhereItsKeySays) {
  for (const Method method : {Method::XRay, Method::ImageAligned}) {
    const auto scene = scene::build_scene(view_by(method));
    const auto off = words_of(scene, with_carry("tiny", "off")), usual = words_of(scene, load_config("tiny")),
               on = words_of(scene, with_carry("tiny", "on"));
    EXPECT_NE(off, on) << scene::to_string(method);
    EXPECT_EQ(usual, method == Method::XRay ? on : off) << scene::to_string(method);
  }
}

TEST(RoundingCarry, DoesNotDependOnThreads) {
  int compared = 0;
  for (const Method method : {Method::XRay, Method::ImageAligned, Method::AxisAligned}) {
    auto description = view_by(method, "marschner-lobb:40");
    description.camera.projection = scene::Projection::Perspective;
    const auto scene = scene::build_scene(description);
    const auto config = with_carry("compact", "on");
    const auto one = words_of(scene, config, 1);
    for (const int threads : {2, 3, 8}) {
      EXPECT_EQ(words_of(scene, config, threads), one) << threads;
      ++compared;
    }
  }
  figure("frames compared", compared);
}

// The report counts vanished splats by their energy; with the carry, nothing is lost.
TEST(RoundingCarry, TheReportCountsVanishedSplats) {
  auto description = view_by(Method::XRay, "marschner-lobb:32");
  description.xray_exposure = 0.05;
  const auto scene = scene::build_scene(description);
  // By hand: all splats of an orthographic view have the radius of their set.
  const double word = std::ldexp(1.0, load_config("tiny").colour_frac_bits) * scene.amplitude * scene.xray_scale;
  double asked = 0.0, gone = 0.0;
  for (const scene::Splat& splat : scene::collect_splats(scene)) {
    const auto material = scene::real_splat(scene, splat).material;
    const double sum = material[0] + material[1] + material[2] + material[3];
    asked += sum;
    if (*std::max_element(material.begin(), material.end()) * word < 0.5) gone += sum;
  }
  const auto lost = render(scene, with_carry("tiny", "off")).report, kept = render(scene, load_config("tiny")).report;
  figure("vanished", static_cast<double>(lost.vanished_voxels));
  figure("of all colour and opacity", 100 * lost.vanished_share, "%");
  EXPECT_FALSE(lost.carried);
  EXPECT_NEAR(lost.vanished_share, gone / asked, 1e-12);  // sums of doubles in another order
  EXPECT_GT(lost.vanished_share, 0.01);
  EXPECT_LT(lost.vanished_share, 0.99);
  EXPECT_TRUE(kept.carried);
  EXPECT_EQ(kept.vanished_share, 0.0);
  EXPECT_LT(kept.vanished_voxels, lost.vanished_voxels);
}

// N-8-58, N-8-61: a splat's remainder goes to its neighbour only. Alone it is rounded half up. Two together are nearer
// than each alone: the mean squared error of a pair is 1/12 instead of 1/6.
TEST(RoundingCarry, ReachesNeighboursOnly) {
  const auto config = load_config("exact");
  const ShownWords shown(config, scene::kernel_by_name("gauss2"));
  const Target to = target(Site::Carried, config);
  RoundingCarry carry(to, shown, 0, 64, 64);
  int alone = 0;
  double pairs = 0.0, each = 0.0;
  constexpr int kLines = 64 * 64;
  for (std::uint32_t line = 0; line < kLines; ++line) {
    const double value = 40.0 + 0.618034 * line - std::floor(0.618034 * line);
    for (const int slice : {0, 2, 5, 9}) {
      EXPECT_EQ(carry(value / to.scale, carry.next(line, slice), 0).word, std::floor(value + 0.5)) << line;
      ++alone;
    }
    const double second = 40.0 + 0.7548777 * line - std::floor(0.7548777 * line);
    double got = static_cast<double>(carry(value / to.scale, carry.next(line, 20), 0).word);
    got += static_cast<double>(carry(second / to.scale, carry.next(line, 21), 0).word);
    pairs += std::pow(got - value - second, 2) / kLines;
    each += std::pow(std::floor(value + 0.5) + std::floor(second + 0.5) - value - second, 2) / kLines;
  }
  figure("splats without a neighbour, rounded half up", alone);
  figure("mean squared error of a pair", pairs, "words^2");
  figure("the same, each rounded", each, "words^2");
  EXPECT_NEAR(pairs, 1.0 / 12, 0.01);
  EXPECT_NEAR(each, 1.0 / 6, 0.01);
}

// A synthetic X-ray on short words, thousands of thin splats behind each other. 3 dB is half the error's power.
TEST(RoundingCarry, AnXrayOfThinSplatsComesNearTheTrueOne) {
  struct Case {
    const char *config, *volume;
    double least_db, least_gain_db;
  };
  for (const Case& one : {Case{"tiny", "shells:64", 44.0, 3.0}, Case{"small", "shells:64", 60.0, 3.0}}) {
    const auto scene = scene::build_scene(view_by(Method::XRay, one.volume));
    const Image truth = golden::render(scene);
    const Lsb8 with = distance(truth, to_image(render(scene, load_config(one.config)).frame)),
               without = distance(truth, to_image(render(scene, with_carry(one.config, "off")).frame));
    figure(std::string(one.config) + ": X-ray, carried", with.psnr_db, "dB");
    figure(std::string(one.config) + ": X-ray, each splat rounded", without.psnr_db, "dB");
    EXPECT_GE(with.psnr_db, one.least_db);
    EXPECT_GE(with.psnr_db - without.psnr_db, one.least_gain_db);
  }
}

}  // namespace
}  // namespace fastsplat::driver
