// Westover's method on the device: every sample composited in the order of the volume (docs/numerics.md, sections 6 and
// 8), and how far its picture is from golden's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "driver/config_file.hpp"
#include "driver/render.hpp"
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

/// Each sample of a pixel rounds its colour twice (slab, light) and adds it cut: 3/2 words, of which what comes later
/// is no more than once as much again; as much for each unit of T, which weighs all that is behind it. Samples a pixel:
/// at most what one ray meets, R kernels wide: (2 R)^2 of each of the volume's layers.
double bound_lsb8(const cmodel::Config& config, int samples) {
  return 255.0 * samples * 3.0 * std::ldexp(1.0, -config.composite_frac_bits);
}

TEST(EverySample, IsAsFarFromGoldenAsItsRoundingsSay) {
  for (const Look& look : kLooks) {
    auto description = westover("shells:24", 96);
    look.on(description);
    const auto config = sampling(look.config);
    const auto scene = scene::build_scene(description);
    const auto device = render(scene, config);
    const Image reference = golden::render(scene);
    const Lsb8 apart = distance(reference, to_image(device.frame));
    const double radius = scene.kernel.radius();
    const int samples = static_cast<int>(4.0 * radius * radius * 24.0);
    figure(std::string(look.name) + ": max", apart.largest, "LSB8");
    figure(std::string(look.name) + ": PSNR", apart.psnr_db, "dB");
    figure(std::string(look.name) + ": bound by roundings", bound_lsb8(config, samples), "LSB8");
    EXPECT_STREQ(device.units.why_plain, look.config[0] == 'b' ? "every sample is composited" : "splats are ellipses");
    EXPECT_GT(device.counters.frozen_pixels + device.counters.pixels_composited, 10000u);
    EXPECT_EQ(device.counters.dirty_blocks, 0u);
    EXPECT_LE(apart.largest, bound_lsb8(config, samples)) << look.name;
    EXPECT_GE(apart.psnr_db, 50.0) << look.name;
  }
}

TEST(EverySample, DimsWhatSheetsAdd) {
  auto description = westover("shells:24", 64);
  const auto config = sampling("base");
  const auto samples = render(scene::build_scene(description), config);
  description.method = scene::Method::AxisAligned;
  const auto sheets = render(scene::build_scene(description), config);
  const Lsb8 apart = distance(to_image(sheets.frame), to_image(samples.frame));
  figure("every sample from axis-aligned sheets, max", apart.largest, "LSB8");
  EXPECT_GT(apart.largest, 2.0);
}

TEST(EverySample, TilesNeverShow) {
  auto description = westover("shells:20", 80);
  auto config = sampling("ellipse");
  description.motion.orbit = 12.0;
  const auto scene = scene::build_scene(description);
  const auto whole = render(scene, config);
  config.tile_width = 16;
  config.tile_height = 24;
  const auto cut = render(scene, config);
  const WordDifference apart = difference(whole.frame, cut.frame);
  figure("words compared", static_cast<double>(apart.compared));
  EXPECT_GT(apart.compared, 0u);
  EXPECT_EQ(apart.different, 0u);
  EXPECT_GT(cut.counters.tiles, whole.counters.tiles);
}

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
