// SPDX-License-Identifier: Apache-2.0
// The chain for frames whose sheets are densities: all device equals the integer model's words, all real equals
// golden's picture, and the real side of the pixel's steps equals golden's stage.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "analysis/pipeline/chain.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::stages {
namespace {

using fastsplat::test::named_config, fastsplat::test::Random, fastsplat::test::random_density_config,
    fastsplat::test::seed_or;
using test::random_density_scene, test::small_density_scenes, test::text_of;

cmodel::Config with_densities(const std::string& name) {
  cmodel::Config config = named_config(name);
  config.classify_segment_bits = 9;
  EXPECT_FALSE(cmodel::first_violation(config)) << name;
  return config;
}

/// Properties of the compared frames.
struct Frames {
  std::uint64_t frames = 0, words = 0, different = 0, lit = 0, dark = 0;
  std::uint64_t in_tiles = 0, perspective = 0, additive = 0, shaded = 0, carried = 0, ellipses = 0, interpolated = 0;

  void print(const char* what) const {
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf("[figure] %s: %llu frames, %llu words (%llu not 0; %llu frames all 0), %llu different\n", what,
                number(frames), number(words), number(lit), number(dark), number(different));
    std::printf(
        "[figure] of them %llu of several tiles, %llu in perspective, %llu additive, %llu shaded, %llu with the carry, "
        "%llu with ellipses, %llu of interpolated tables\n",
        number(in_tiles), number(perspective), number(additive), number(shaded), number(carried), number(ellipses),
        number(interpolated));
  }
};

/// With the function's own gradient floor, and with floors near many pixels, in turn.
scene::Scene scene_of(const scene::SceneDescription& description, std::uint64_t number) {
  scene::Scene scene = scene::build_scene(description);
  scene.shading.gradient_floor *= static_cast<double>(1U << number % 6);
  return scene;
}

void against_device(const scene::SceneDescription& description, const cmodel::Config& config, Frames& all) {
  const scene::Scene scene = scene_of(description, all.frames);
  const Chain chain(scene, config);
  const cmodel::Frame frame = driver::render(scene, config, {.threads = 1}).frame;
  const Picture picture = chain(Mixture::all_device());
  ASSERT_EQ(picture.pixels.size() * 4, frame.words.size());
  const std::uint64_t before = all.different, lit = all.lit;
  for (std::size_t i = 0; i < frame.words.size(); ++i) {
    const bool same = std::ldexp(picture.pixels[i / 4][i % 4], frame.frac_bits) == static_cast<double>(frame.words[i]);
    all.different += same ? 0 : 1;
    all.lit += frame.words[i] != 0 ? 1 : 0;
  }
  EXPECT_EQ(all.different, before) << text_of(config) << "\n"
                                   << scene::to_toml(description) << "gradient floor " << scene.shading.gradient_floor;
  all.words += frame.words.size();
  all.dark += all.lit == lit ? 1 : 0;
  ++all.frames;
  all.in_tiles += driver::TileGrid(config, description.width, description.height, 1).count() > 1 ? 1 : 0;
  all.perspective += description.camera.projection == scene::Projection::Perspective ? 1 : 0;
  all.additive += description.slab_opacity == scene::SlabOpacity::Additive ? 1 : 0;
  all.shaded += scene.shading.on ? 1 : 0;
  all.carried += chain.steps().carries() ? 1 : 0;
  all.ellipses += chain.steps().shaped() ? 1 : 0;
  all.interpolated += config.interpolates() ? 1 : 0;
}

/// `frames` more of random configurations and scenes.
void against_device_at_random(Random& random, cmodel::IndexKind kind, std::uint64_t frames, Frames& all) {
  const std::uint64_t wanted = all.frames + frames;
  while (all.frames < wanted) {
    const cmodel::Config config = random_density_config(random, kind);
    scene::SceneDescription description = random_density_scene(random);
    if (config.has_ellipses() && description.camera.projection == scene::Projection::Perspective)
      description.footprint.shape = scene::FootprintShape::Ellipse;
    try {
      against_device(description, config, all);
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
}

TEST(DensityChain, AllDeviceIsTheIntegerModelBitForBit) {
  Frames all;
  for (const char* name : {"base", "fine"}) {
    for (const scene::SceneDescription& description : small_density_scenes())
      against_device(description, with_densities(name), all);
  }
  Random random(seed_or(2110));
  against_device_at_random(random, cmodel::IndexKind::Rlut, 100, all);
  all.print("all device");
  EXPECT_GT(all.words, 100000u);
  EXPECT_GT(all.lit, all.words / 5);
  EXPECT_LT(all.dark, all.frames / 4);
  for (const std::uint64_t met :
       {all.in_tiles, all.perspective, all.additive, all.shaded, all.carried, all.ellipses, all.interpolated})
    EXPECT_GE(met, 5u);
}

TEST(DensityChain, AllDeviceIsTheIntegerModelForEveryKindOfIndex) {
  Frames all;
  Random random(seed_or(2111));
  for (int kind = 0; kind < 6; ++kind) against_device_at_random(random, static_cast<cmodel::IndexKind>(kind), 6, all);
  all.print("six kinds of index");
  EXPECT_EQ(all.frames, 36u);
  EXPECT_GT(all.lit, all.words / 20);
}

/// Views that take every path through golden's stage.
std::vector<scene::SceneDescription> density_views(int size) {
  std::vector<scene::SceneDescription> all;
  for (scene::SceneDescription& description : small_density_scenes()) {
    description.width = size;
    description.height = size - 5;  // the last band is not whole
    for (const int shading : {0, 1}) {
      description.shading = shading;
      all.push_back(description);
    }
  }
  all.push_back(all.back());
  all.back().transfer_function = "binary";
  all.push_back(all.front());
  all.back().opacity_scale = 40.0;
  return all;
}

TEST(DensityChain, AllRealIsGoldenFloatByFloat) {
  std::uint64_t frames = 0, floats = 0, different = 0, lit = 0;
  std::vector<scene::SceneDescription> all = density_views(48);
  Random random(seed_or(2112));
  while (all.size() < 30) all.push_back(random_density_scene(random));
  for (const scene::SceneDescription& description : all) {
    const scene::Scene scene = scene_of(description, frames);
    const cmodel::Config config = with_densities(frames % 2 == 0 ? "base" : "fine");
    const Image image = golden::render(scene);
    const Picture picture = Chain(scene, config)(Mixture{}, 2);
    const std::uint64_t before = different;
    for (std::size_t i = 0; i < image.data.size(); ++i) {
      different += image.data[i] == static_cast<float>(picture.pixels[i / 4][i % 4]) ? 0 : 1;
      lit += image.data[i] != 0.0F ? 1 : 0;
    }
    EXPECT_EQ(different, before) << scene::to_toml(description);
    floats += image.data.size();
    ++frames;
  }
  std::printf("[figure] %llu frames, %llu floats (%llu not 0), %llu different\n",
              static_cast<unsigned long long>(frames), static_cast<unsigned long long>(floats),
              static_cast<unsigned long long>(lit), static_cast<unsigned long long>(different));
  EXPECT_GT(lit, floats / 4);
}

TEST(DensityChain, ThreadsChangeNothing) {
  const scene::Scene scene = scene::build_scene(density_views(70).front());
  const cmodel::Config config = with_densities("base");
  const Chain chain(scene, config);
  for (const Mixture& mixture : {Mixture{}, Mixture::all_device(), Mixture{Step::Slope}})
    EXPECT_EQ(chain(mixture, 1), chain(mixture, 3)) << mixture.text();
}

TEST(DensityChain, StepsOfDensitiesAreListedForDensitiesOnly) {
  const auto description = small_density_scenes().front();
  const cmodel::Config config = with_densities("base");
  const auto steps_listed = [&](const scene::SceneDescription& of) {
    const scene::Scene scene = scene::build_scene(of);
    std::size_t steps = 0;
    for (const StepSet& set : Chain(scene, config).sets()) steps += set.steps.size();
    return steps;
  };
  auto colours = description;
  colours.classify = scene::ClassifyOrder::Pre;
  EXPECT_EQ(steps_listed(description), kStepCount);
  EXPECT_EQ(steps_listed(colours), kStepCount - 8);
  EXPECT_EQ(group_sets(true).size(), 6u);
  EXPECT_EQ(group_sets(false).size(), 5u);
}

TEST(DensityChain, ScenesWithoutStepsAreRefused) {
  const auto refused = [](const scene::SceneDescription& description, const cmodel::Config& config,
                          const std::string& why) {
    const scene::Scene scene = scene::build_scene(description);
    try {
      const Chain chain(scene, config);
      ADD_FAILURE() << "not refused: " << why;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  const auto plain = small_density_scenes().front();
  refused(plain, named_config("base"), "classify.segment_bits");
  auto patterned = plain;
  patterned.texture.kind = scene::SolidKind::Marble;
  patterned.texture.where = scene::TextureWhere::Pixel;
  cmodel::Config config = with_densities("base");
  config.pattern_node_bits = 4;
  refused(patterned, config, "error attribution");
  auto bumpy = plain;
  bumpy.bump.kind = scene::SolidKind::Marble;
  refused(bumpy, config, "error attribution");
  auto scene = scene::build_scene(plain);
  scene.transfer_function.points = {{0.0, glm::dvec3(1.0), 0.5}, {1.0, glm::dvec3(1.0), 0.5}};
  EXPECT_THROW(Chain(scene, config), UserError) << "what lies around the volume would be seen";
}

}  // namespace
}  // namespace fastsplat::stages
