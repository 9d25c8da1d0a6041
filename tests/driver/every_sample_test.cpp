// SPDX-License-Identifier: Apache-2.0
// Westover's method on the device: every sample composited in the order of the volume (docs/numerics.md, sections 6 and
// 8), and how far its picture is from golden's.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

cmodel::Config sampling(const std::string& name) {
  cmodel::Config config = load_config(name);
  config.composite_every_sample = 1;
  return config;
}

scene::SceneDescription westover(const std::string& volume, int size) {
  auto description = view_of(volume, size);
  description.method = scene::Method::Westover;
  return description;
}

struct Look {
  const char* name;
  const char* config;
  void (*on)(scene::SceneDescription&);
};
const Look kLooks[] = {
    {"exponential", "base", [](scene::SceneDescription&) {}},
    {"additive", "base", [](scene::SceneDescription& d) { d.slab_opacity = scene::SlabOpacity::Additive; }},
    {"perspective ellipses", "ellipse",
     [](scene::SceneDescription& d) {
       d.camera.projection = scene::Projection::Perspective;
       d.footprint.shape = scene::FootprintShape::Ellipse;
     }},
    {"motion", "ellipse", [](scene::SceneDescription& d) { d.motion.orbit = 12.0; }},
};

// The limits of sheets of ellipses (ellipses_test.cpp).
TEST(EverySample, IsWithinOneLsb8OfGolden) {
  for (const Look& look : kLooks) {
    auto description = westover("shells:24", 96);
    look.on(description);
    const auto config = sampling(look.config);
    const auto scene = scene::build_scene(description);
    const auto device = render(scene, config);
    const Image reference = golden::render(scene);
    const Lsb8 apart = distance(reference, to_image(device.frame));
    figure(std::string(look.name) + ": max", apart.largest, "LSB8");
    figure(std::string(look.name) + ": PSNR", apart.psnr_db, "dB");
    EXPECT_GT(device.counters.frozen_pixels + device.counters.pixels_composited, 10000u);
    EXPECT_EQ(device.counters.dirty_blocks, 0u);
    EXPECT_LE(apart.largest, 1.0) << look.name;
    EXPECT_GE(apart.psnr_db, 57.0) << look.name;
  }
}

/// Mean alpha of a picture, LSB8.
double mean_alpha(const cmodel::Frame& frame) {
  const Image image = to_image(frame);
  double sum = 0.0;
  for (std::size_t i = 3; i < image.data.size(); i += 4) sum += image.data[i];
  return 255.0 * sum / (static_cast<double>(image.data.size()) / 4.0);
}

// A layer adds a1 + a2, which is more than its samples leave, a1 + a2 (1 - a1): Westover's picture is thinner.
TEST(EverySample, DimsTheSumsOfSheets) {
  auto description = westover("shells:24", 64);
  description.slab_opacity = scene::SlabOpacity::Additive;
  const auto config = sampling("base");
  const double samples = mean_alpha(render(scene::build_scene(description), config).frame);
  description.method = scene::Method::AxisAligned;
  const double sheets = mean_alpha(render(scene::build_scene(description), config).frame);
  figure("mean alpha of sheets", sheets, "LSB8");
  figure("mean alpha of every sample", samples, "LSB8");
  EXPECT_GT(samples, 0.5 * sheets);
  EXPECT_LT(samples, sheets);
}

TEST(EverySample, TilesNeverShow) {
  auto description = westover("shells:20", 80);
  description.motion.orbit = 12.0;
  expect_tiles_never_show(description, sampling("ellipse"));
}

// N-8-63.
TEST(EverySample, IsRefusedByADeviceWithout) {
  try {
    render(scene::build_scene(westover("shells:12", 32)), load_config("base"));
    ADD_FAILURE() << "was drawn";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    const std::string what = error.what();
    EXPECT_NE(what.find("westover"), std::string::npos) << what;
    EXPECT_NE(what.find("composite.every_sample"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace fastsplat::driver
