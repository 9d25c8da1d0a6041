// SPDX-License-Identifier: Apache-2.0
// The chain of steps: all device equals the integer model, all real equals golden, and each single step follows its
// page.
#include "analysis/pipeline/chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::stages {
namespace {

scene::SceneDescription view_of(const std::string& volume, int size) {
  scene::SceneDescription description;
  description.volume = volume;
  description.width = description.height = size;
  return description;
}

/// Views that take every path through the chain.
std::vector<scene::SceneDescription> views(int size) {
  std::vector<scene::SceneDescription> all;
  all.push_back(view_of("shells:24", size));
  all.back().camera.azimuth = 25.0;
  all.back().camera.elevation = 15.0;
  all.push_back(all.front());
  all.back().camera.projection = scene::Projection::Perspective;
  all.push_back(all.front());
  all.back().slab_opacity = scene::SlabOpacity::Additive;
  all.push_back(all.front());
  all.back().method = scene::Method::AxisAligned;
  all.push_back(all.front());
  all.back().method = scene::Method::XRay;
  all.push_back(all.front());
  all.back().method = scene::Method::XRay;
  all.back().xray_sheets = 5;
  all.push_back(all.front());
  all.back().slab_width = 0.37;
  all.back().opacity_scale = 6.0;
  return all;
}

struct Differences {
  std::uint64_t frames = 0, compared = 0, different = 0;
  void add(bool same) {
    ++compared;
    different += same ? 0 : 1;
  }
  void print(const char* what) const {
    std::printf("[figure] %llu frames, %llu %s, %llu different\n", static_cast<unsigned long long>(frames),
                static_cast<unsigned long long>(compared), what, static_cast<unsigned long long>(different));
  }
};

/// Views of a configuration against the integer model.
void against_device(const cmodel::Config& config, const std::vector<scene::SceneDescription>& views, Differences& all) {
  for (const auto& description : views) {
    const scene::Scene scene = scene::build_scene(description);
    const cmodel::Frame frame = driver::render(scene, config).frame;
    const Picture picture = Chain(scene, config)(Mixture::all_device(), 2);
    const std::uint64_t before = all.different;
    for (std::size_t i = 0; i < frame.words.size(); ++i)
      all.add(std::ldexp(picture.pixels[i / 4][i % 4], frame.frac_bits) == static_cast<double>(frame.words[i]));
    EXPECT_EQ(all.different, before) << config.name << ", index kind " << config.index_kind << ", view "
                                     << all.frames % views.size();
    ++all.frames;
  }
}

/// And against golden.
void against_golden(const cmodel::Config& config, const std::vector<scene::SceneDescription>& views, Differences& all) {
  for (const auto& description : views) {
    const scene::Scene scene = scene::build_scene(description);
    const Image image = golden::render(scene);
    const Picture picture = Chain(scene, config)(Mixture{}, 2);
    const std::uint64_t before = all.different;
    for (std::size_t i = 0; i < image.data.size(); ++i)
      all.add(image.data[i] == static_cast<float>(picture.pixels[i / 4][i % 4]));
    EXPECT_EQ(all.different, before) << config.name << ", view " << all.frames % views.size();
    ++all.frames;
  }
}

TEST(Chain, AllDeviceIsTheIntegerModelBitForBit) {
  Differences all;
  for (const std::string& name : test::config_names()) against_device(test::named_config(name), views(40), all);
  all.print("words");
  EXPECT_GT(all.compared, 100000u);
}

TEST(Chain, AllDeviceIsTheIntegerModelForEveryKindOfIndex) {
  Differences all;
  for (int kind = 0; kind < 6; ++kind) {
    for (const char* name : {"base", "compact", "tiny"}) {
      cmodel::Config config = test::named_config(name);
      config.index_kind = kind;
      if (cmodel::first_violation(config)) {
        config.rlut_columns = 16;  // blit2d stores a footprint for every two phases
        config.phases = std::min(config.phases, 16);
        config.position_frac_bits = std::min(config.position_frac_bits, 5);
      }
      ASSERT_FALSE(cmodel::first_violation(config)) << kind << " " << name;
      against_device(config, views(24), all);
    }
  }
  all.print("words of six kinds of index");
  EXPECT_GT(all.compared, 100000u);
}

/// Frames whose splats have individual shapes, alone and together.
std::vector<scene::SceneDescription> shaped_views(int size) {
  std::vector<scene::SceneDescription> all;
  const auto view = [&]() -> scene::SceneDescription& {
    all.push_back(view_of("shells:16", size));
    all.back().camera.azimuth = 25.0;
    all.back().camera.elevation = 15.0;
    return all.back();
  };
  const auto perspective = [](scene::SceneDescription& d) {
    d.camera.projection = scene::Projection::Perspective;
    d.camera.fov = 60.0;
    d.footprint.shape = scene::FootprintShape::Ellipse;
  };
  perspective(view());
  view().footprint.antialias = true;
  all.back().camera.zoom = 0.3;
  view().motion.translate = {3.0, 1.0, 0.5};
  scene::SceneDescription& lens = view();
  lens.lens.depth_of_field = scene::DepthOfField::Splats;
  lens.lens.aperture = 1.5;
  lens.camera.projection = scene::Projection::Perspective;
  scene::SceneDescription& mixed = view();
  perspective(mixed);
  mixed.footprint.antialias = true;
  mixed.motion.orbit = 6.0;
  mixed.slab_opacity = scene::SlabOpacity::Additive;
  perspective(view());
  all.back().method = scene::Method::AxisAligned;
  perspective(view());
  all.back().method = scene::Method::XRay;
  all.back().xray_sheets = 5;
  view().footprint.antialias = true;
  all.back().camera.zoom = 0.2;
  all.back().slab_width = 0.6;
  all.back().opacity_scale = 6.0;
  view().motion.translate = {6.0, 1.0, 0.0};
  all.back().camera.zoom = 0.06;  // thinner than kThinnest
  perspective(view());
  all.back().volume = "shells:6";  // of several rows of windows
  all.back().motion.translate = {0.5, 0.2, 0.0};
  return all;
}

cmodel::Config with_carry(cmodel::Config config) {
  config.rounding_carry = static_cast<int>(cmodel::Carry::On);
  return config;
}

TEST(Chain, AllDeviceIsTheIntegerModelWithEllipses) {
  Differences all;
  const cmodel::Config config = test::named_config("ellipse");
  const std::vector<scene::SceneDescription> views = shaped_views(40);
  std::size_t grown = 0, stretched = 0;
  for (const auto& description : views) {
    const scene::Scene scene = scene::build_scene(description);
    const Chain chain(scene, config);
    const Staged staged = chain.steps().staged(chain.list(), Mixture::all_device(), false, 2);
    const auto own = std::ranges::count_if(staged.shapes, [](const StagedShape& shape) { return shape.own; });
    EXPECT_GT(own, 40);  // the least has 56 voxels
    grown += std::ranges::any_of(staged.shapes, [](const StagedShape& shape) { return shape.growth.shrink < 65536; });
    stretched += std::ranges::any_of(staged.shapes, [](const StagedShape& shape) { return shape.words.b != 0; });
  }
  std::printf("[figure] of %zu views %zu have kernels that grow in depth, %zu ellipses that lie obliquely\n",
              views.size(), grown, stretched);
  EXPECT_GE(grown, 3u);
  EXPECT_GE(stretched, 4u);
  against_device(config, views, all);
  against_device(with_carry(config), views, all);
  all.print("words of frames with ellipses");
  EXPECT_GT(all.compared, 100000u);
}

TEST(Chain, AllRealIsGoldenWithEllipses) {
  Differences all;
  against_golden(test::named_config("ellipse"), shaped_views(48), all);
  all.print("floats of frames with ellipses");
  EXPECT_GT(all.compared, 70000u);
}

TEST(Chain, AllRealIsGoldenFloatByFloat) {
  Differences all;
  for (const char* name : {"base", "tiny"}) against_golden(test::named_config(name), views(48), all);
  all.print("floats");
  EXPECT_GT(all.compared, 100000u);
}

/// The same views with every sample composited individually, once each, and configurations that can.
std::vector<scene::SceneDescription> sampled(const std::vector<scene::SceneDescription>& views) {
  std::vector<scene::SceneDescription> all;
  for (scene::SceneDescription view : views) {
    if (view.method != scene::Method::ImageAligned) continue;
    view.method = scene::Method::Westover;
    view.slab_width = scene::SceneDescription{}.slab_width;
    all.push_back(view);
  }
  return all;
}

cmodel::Config sampling(const std::string& name) {
  cmodel::Config config = test::named_config(name);
  config.composite_lanes = 0;
  config.composite_every_sample = 1;
  return config;
}

TEST(Chain, EverySampleAllDeviceIsTheIntegerModel) {
  Differences all;
  for (const std::string& name : test::config_names()) against_device(sampling(name), sampled(views(32)), all);
  against_device(sampling("ellipse"), sampled(shaped_views(40)), all);
  all.print("words of frames of every sample");
  EXPECT_GT(all.compared, 150000u);
}

TEST(Chain, EverySampleAllRealIsGoldenFloatByFloat) {
  Differences all;
  against_golden(sampling("base"), sampled(views(48)), all);
  against_golden(sampling("ellipse"), sampled(shaped_views(48)), all);
  all.print("floats of frames of every sample");
  EXPECT_GT(all.compared, 80000u);
}

TEST(Chain, StepsAreNotOfPatterns) {
  auto description = views(24).front();
  description.texture.kind = scene::SolidKind::Marble;
  const scene::Scene scene = scene::build_scene(description);
  cmodel::Config config = test::named_config("base");
  config.pattern_node_bits = 4;
  EXPECT_THROW(Chain(scene, config), UserError);
}

}  // namespace
}  // namespace fastsplat::stages
