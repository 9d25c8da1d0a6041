// SPDX-License-Identifier: Apache-2.0
// Mixtures of steps against a second implementation of their page (tests/pipeline/oracle): random ones, and step by
// step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "analysis/pipeline/chain.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"
#include "tests/pipeline/oracle/render.hpp"

namespace fastsplat::stages {
namespace {

using fastsplat::test::Random, fastsplat::test::named_config, fastsplat::test::random_config, fastsplat::test::seed_or;
using fastsplat::test::random_density_config;
using test::random_density_scene, test::random_floats, test::random_mixture, test::random_mixture_with_floats,
    test::random_scene, test::small_density_scenes, test::small_scenes, test::text_of;

/// The difference between two orders of the same sums: thousands of terms at a pixel, n 2^-53 of a sum of n, and as
/// much again for the later steps. A word may differ if its rounding depends on that: oracle::Closeness marks these
/// pixels.
constexpr double kBound = 1e-12;

/// For densities with only real steps, golden draws them: in floats after the gradient (density_steps_test.cpp derives
/// the bound, 110 2^-24 of the largest visible value).
constexpr double kGoldensFloats = 1e-5;

struct Figures {
  std::uint64_t mixtures = 0, values = 0, close = 0;
  std::uint64_t over = 0;          ///< beyond the bound without an explanation
  std::uint64_t lit = 0;           ///< values that are not 0
  std::uint64_t floats = 0;        ///< mixtures that golden draws in floats
  std::uint64_t over_at_edge = 0;  ///< beyond it at a pixel that depends on the last bits of a double
  double largest = 0.0;            ///< of all others

  void print(const char* what) const {
    std::printf(
        "[figure] %s: %llu mixtures, %llu values, largest difference %.2g, %llu beyond %.0e; at %llu pixels a decision "
        "within a double's last bits, %llu of their values beyond it\n",
        what, static_cast<unsigned long long>(mixtures), static_cast<unsigned long long>(values), largest,
        static_cast<unsigned long long>(over), kBound, static_cast<unsigned long long>(close),
        static_cast<unsigned long long>(over_at_edge));
  }
};

void compare(const scene::Scene& scene, const cmodel::Config& config, const Chain& chain, const Mixture& mixture,
             Figures& figures) {
  const Picture picture = chain(mixture);
  std::vector<bool> close;
  const auto expected = oracle::render(scene, config, mixture, &close);
  ASSERT_EQ(picture.pixels.size(), expected.size());
  ++figures.mixtures;
  const std::uint64_t over_before = figures.over;
  double worst = 0.0;
  const bool floats = chain.holds_densities() && mixture == Mixture{};
  const double bound = floats ? kGoldensFloats : kBound;
  figures.floats += floats ? 1 : 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) figures.lit += expected[i][c] != 0.0 ? 1 : 0;
    figures.close += close[i] ? 1 : 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const double here = picture.pixels[i][c], there = expected[i][c];
      const bool same = here == there || (std::isnan(here) && std::isnan(there));  // floats may overflow
      const double difference = same ? 0.0 : std::abs(here - there);
      const bool over = !(difference <= bound * std::max(1.0, std::abs(expected[i][c])));
      ++figures.values;
      if (over && close[i]) {
        ++figures.over_at_edge;
        continue;
      }
      figures.over += over ? 1 : 0;
      worst = std::max(worst, floats ? 0.0 : difference);
    }
  }
  figures.largest = std::max(figures.largest, worst);
  EXPECT_EQ(figures.over, over_before) << "largest difference " << worst << "\n  device: " << mixture.text() << "\n  "
                                       << text_of(config) << "\n"
                                       << scene::to_toml(scene.description);
}

/// The same scene with every sample composited individually.
void sample(scene::SceneDescription& description) {
  description.method = scene::Method::Westover;
  description.slab_width = scene::SceneDescription{}.slab_width;
  description.xray_sheets = 1;
  description.xray_exposure = 0.0;
}

/// Cases that occurred in the random mixtures.
struct Met {
  std::uint64_t drawn = 0, perspective = 0, xray_sheets = 0, carried = 0, light_carried = 0;
  std::array<std::uint64_t, 5> methods{};
  std::array<std::uint64_t, 3> snapped_coarsely{};  ///< k < 2^pf, by R_s

  void add(const scene::SceneDescription& scene, const cmodel::Config& config) {
    const bool xray = scene.method == scene::Method::XRay;
    perspective += scene.camera.projection == scene::Projection::Perspective ? 1 : 0;
    xray_sheets += xray && scene.xray_sheets > 1 ? 1 : 0;
    carried += config.rounding_carry == static_cast<int>(cmodel::Carry::On) ? 1 : 0;
    light_carried += xray && config.rounding_carry == static_cast<int>(cmodel::Carry::XRay) ? 1 : 0;
    ++methods[static_cast<std::size_t>(scene.method)];
    if (config.phases < (1 << config.position_frac_bits)) {
      ++snapped_coarsely[static_cast<std::size_t>(config.rounding_snap)];
    }
  }
  void print() const {
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf(
        "[figure] %llu drawn, the configurations of others cannot hold the scene; %llu in "
        "perspective; %llu image-aligned, %llu axis-aligned, %llu of every sample, %llu X-rays (%llu of several "
        "sheets); carry on in %llu, "
        "xray in %llu X-rays; k < 2^pf: %llu trn, %llu rnd, %llu rnd_conv\n",
        number(drawn), number(perspective), number(methods[4]), number(methods[3]), number(methods[2]),
        number(methods[1]), number(xray_sheets), number(carried), number(light_carried), number(snapped_coarsely[0]),
        number(snapped_coarsely[1]), number(snapped_coarsely[2]));
  }
};

class OfAKind : public ::testing::TestWithParam<cmodel::IndexKind> {};

INSTANTIATE_TEST_SUITE_P(Mixtures, OfAKind,
                         ::testing::Values(cmodel::IndexKind::Linear, cmodel::IndexKind::Squared,
                                           cmodel::IndexKind::SquaredElliptic, cmodel::IndexKind::Blit2d,
                                           cmodel::IndexKind::Rlut, cmodel::IndexKind::Separable),
                         [](const auto& param_info) {
                           return std::string(
                               cmodel::find_key("index.kind")->names[static_cast<std::size_t>(param_info.param)]);
                         });

TEST_P(OfAKind, AtRandomTheChainIsItsPage) {
  const cmodel::IndexKind kind = GetParam();
  const std::uint64_t wanted = kind == cmodel::IndexKind::Rlut ? 200 : 40;
  Random random(seed_or(2100));
  Figures figures;
  Met met;
  while (figures.mixtures < wanted) {
    const cmodel::Config config = random_config(random, kind);
    scene::SceneDescription description = random_scene(random);
    if (config.composite_every_sample != 0 && random.once_in(2)) sample(description);
    const scene::Scene scene = scene::build_scene(description);
    const Mixture mixture = random_mixture(random);
    ++met.drawn;
    try {
      const Chain chain(scene, config);
      met.add(scene.description, config);
      compare(scene, config, chain, mixture, figures);
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
  figures.print("random");
  EXPECT_LE(figures.over_at_edge * 10000, figures.values);
  met.print();
  EXPECT_GT(met.methods[static_cast<std::size_t>(scene::Method::Westover)], wanted / 20);
}

// docs/floats.md: sheets, every sample and densities; all steps floats, and steps of all three sides.
TEST(Mixtures, OfFloatsAtRandomTheChainIsItsPage) {
  Random random(seed_or(2160));
  Figures all_floats, sides;
  std::uint64_t sampled = 0, densities = 0, overflowed = 0;
  while (sides.mixtures < 200) {
    const bool dense = random.once_in(4);
    using enum cmodel::IndexKind;
    constexpr std::array kKinds{Linear, Squared, SquaredElliptic, Blit2d, Rlut, Separable};
    const cmodel::IndexKind kind = kKinds[static_cast<std::size_t>(random.between(0, kKinds.size() - 1))];
    const cmodel::Config config = dense ? random_density_config(random) : random_config(random, kind);
    scene::SceneDescription description = dense ? random_density_scene(random) : random_scene(random);
    if (!dense && config.composite_every_sample != 0 && random.once_in(2)) sample(description);
    const scene::Scene scene = scene::build_scene(description);
    const Mixture floats = Mixture::all_floats(random_floats(random)), mixture = random_mixture_with_floats(random);
    try {
      const Chain chain(scene, config);
      compare(scene, config, chain, floats, all_floats);
      compare(scene, config, chain, mixture, sides);
      densities += dense ? 1 : 0;
      sampled += description.method == scene::Method::Westover ? 1 : 0;
      for (const golden::Sums& pixel : chain(floats).pixels) overflowed += std::isfinite(pixel[0]) ? 0 : 1;
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
  all_floats.print("floats");
  sides.print("floats beside integers and reals");
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("[figure] scenes with every sample %llu, densities %llu; pixels that overflowed %llu\n", number(sampled),
              number(densities), number(overflowed));
  EXPECT_GT(all_floats.lit, all_floats.values / 5);
  EXPECT_GT(sampled, 20u);
  EXPECT_GT(densities, 20u);
  EXPECT_LE(all_floats.over_at_edge * 1000, all_floats.values);
  EXPECT_LE(sides.over_at_edge * 1000, sides.values);
}

TEST(Mixtures, OfDensitiesAtRandomTheChainIsItsPage) {
  Random random(seed_or(2130));
  Figures figures;
  while (figures.mixtures < 200) {
    const cmodel::Config config = random_density_config(random);
    scene::Scene scene = scene::build_scene(random_density_scene(random));
    scene.shading.gradient_floor *= static_cast<double>(1U << figures.mixtures % 6);
    const Mixture mixture = random_mixture(random, true);
    try {
      const Chain chain(scene, config);
      compare(scene, config, chain, mixture, figures);
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
  figures.print("densities");
  std::printf("[figure] %llu values not 0; %llu mixtures in golden's floats\n",
              static_cast<unsigned long long>(figures.lit), static_cast<unsigned long long>(figures.floats));
  EXPECT_GT(figures.lit, figures.values / 4);
  EXPECT_LE(figures.over_at_edge * 1000, figures.values);
}

TEST(Mixtures, OfDensitiesEachStepAloneAndAllButOne) {
  Figures alone, others;
  for (const char* name : {"base", "fine"}) {
    cmodel::Config config = named_config(name);
    config.classify_segment_bits = 6;
    for (const scene::SceneDescription& description : small_density_scenes()) {
      scene::Scene scene = scene::build_scene(description);
      scene.shading.gradient_floor = 0.1;  // chosen so that many pixels are between it and twice that
      const Chain chain(scene, config);
      for (const Step step : all_steps()) {
        compare(scene, config, chain, Mixture{step}, alone);
        compare(scene, config, chain, Mixture::all_device().with({&step, 1}, false), others);
      }
    }
  }
  alone.print("densities, each step alone");
  others.print("densities, all but one step");
  EXPECT_GT(alone.lit, alone.values / 4);
}

TEST(Mixtures, EachStepAloneAndAllButOne) {
  Figures alone, others;
  for (const char* name : {"base", "tiny", "year2000"}) {
    cmodel::Config config = named_config(name);
    config.composite_lanes = 0;
    config.composite_every_sample = 1;
    std::vector<scene::SceneDescription> scenes = small_scenes();
    scenes.push_back(scenes[0]);
    sample(scenes.back());
    scenes.push_back(scenes[1]);
    sample(scenes.back());
    for (const scene::SceneDescription& description : scenes) {
      const scene::Scene scene = scene::build_scene(description);
      const Chain chain(scene, config);
      for (const Step step : all_steps()) {
        compare(scene, config, chain, Mixture{step}, alone);
        compare(scene, config, chain, Mixture::all_device().with({&step, 1}, false), others);
      }
    }
  }
  alone.print("each step alone");
  others.print("all but one step");
}

TEST(Mixtures, AllDeviceOfThePageIsTheIntegerModel) {
  Random random(seed_or(2101));
  std::uint64_t frames = 0, words = 0, different = 0;
  const auto check = [&](const scene::SceneDescription& description, const cmodel::Config& config) {
    const scene::Scene scene = scene::build_scene(description);
    const cmodel::Frame frame = driver::render(scene, config, {.unit = driver::Unit::Plain}).frame;
    const auto expected = oracle::render(scene, config, Mixture::all_device());
    const std::uint64_t before = different;
    for (std::size_t i = 0; i < frame.words.size(); ++i) {
      different += std::ldexp(expected[i / 4][i % 4], frame.frac_bits) == static_cast<double>(frame.words[i]) ? 0 : 1;
    }
    EXPECT_EQ(different, before) << text_of(config) << "\n" << scene::to_toml(scene.description);
    words += frame.words.size();
    ++frames;
  };
  for (const std::string& name : fastsplat::test::config_names()) {
    for (const scene::SceneDescription& description : small_scenes()) check(description, named_config(name));
  }
  while (frames < 100) {
    const cmodel::Config config = random_config(random);
    const scene::SceneDescription description = random_scene(random);
    try {
      check(description, config);
    } catch (const UserError&) {
      continue;
    }
  }
  std::printf("[figure] %llu frames, %llu words, %llu different\n", static_cast<unsigned long long>(frames),
              static_cast<unsigned long long>(words), static_cast<unsigned long long>(different));
}

TEST(Mixtures, AllRealOfThePageIsGolden) {
  const cmodel::Config config = named_config("base");
  Random random(seed_or(2102));
  std::uint64_t floats = 0, next = 0;
  std::vector<scene::SceneDescription> scenes = small_scenes();
  while (scenes.size() < 40) scenes.push_back(random_scene(random));
  for (const scene::SceneDescription& description : scenes) {
    const scene::Scene scene = scene::build_scene(description);
    const Image image = golden::render(scene);
    const auto expected = oracle::render(scene, config, Mixture{});
    for (std::size_t i = 0; i < image.data.size(); ++i) {
      // Sums in another order may round to the next float.
      const auto value = static_cast<float>(expected[i / 4][i % 4]);
      next += image.data[i] == value ? 0 : 1;
      EXPECT_NEAR(image.data[i], value, std::ldexp(std::max(1e-6f, std::abs(value)), -23)) << i;
      ++floats;
    }
  }
  std::printf("[figure] %zu frames, %llu floats, %llu the next one\n", scenes.size(),
              static_cast<unsigned long long>(floats), static_cast<unsigned long long>(next));
}

}  // namespace
}  // namespace fastsplat::stages
