// SPDX-License-Identifier: Apache-2.0
// The chain of 3-D Gaussians: all device equals the integer model bit for bit, all real is golden's picture, and a
// followed pixel is that of the picture in every mixture.
#include "golden/gaussians.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "analysis/pipeline/pixel_trace.hpp"
#include "base/error.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::stages {
namespace {

scene::GaussianScene scene_of(const std::string& name, double zoom, scene::Projection projection,
                              float brightness = 1.0F) {
  scene::GaussianDescription description;
  description.camera.projection = projection;
  description.camera.zoom = zoom;
  description.width = 90, description.height = 70;
  description.up = scene::UpAxis::Z;
  auto cloud = scene::make_synthetic_gaussians(name);
  for (glm::vec3& harmonic : cloud.harmonics) harmonic *= brightness;
  return scene::build_gaussian_scene(description, std::make_shared<scene::GaussianCloud>(std::move(cloud)));
}

std::vector<scene::GaussianScene> scenes() {
  using enum scene::Projection;
  return {scene_of("cloud:300", 1.0, Perspective), scene_of("shells:900", 1.0, Orthographic),
          scene_of("shells:500", 2.5, Perspective), scene_of("cloud:200", 1.0, Perspective, 2.0F)};
}

cmodel::Config usual_config() {
  cmodel::Config config = fastsplat::test::named_config("ellipse");
  config.composite_every_sample = 1;
  config.freeze_below = 7;
  return config;
}

/// The usual one, a coarse one, one with other roundings, and one whose colours may exceed 1.
std::vector<cmodel::Config> configs() {
  std::vector<cmodel::Config> all(4, usual_config());
  all[1].sheet_frac_bits = 10;
  all[1].composite_frac_bits = 10;
  all[1].freeze_below = 1;
  all[1].tile_width = 32;
  all[1].tile_height = 24;
  all[2].radial_entries = 64;
  all[2].rounding_product = static_cast<int>(cmodel::Rounding::RND_CONV);
  all[2].rounding_light = static_cast<int>(cmodel::Rounding::TRN);
  all[3].colour_int_bits = 1;
  all[3].colour_frac_bits = 14;
  for (const cmodel::Config& config : all) EXPECT_FALSE(cmodel::first_violation(config));
  return all;
}

TEST(GaussianChain, AllDeviceIsTheIntegerModelBitForBit) {
  std::size_t words = 0, different = 0, light = 0;
  for (const cmodel::Config& config : configs()) {
    for (const scene::GaussianScene& scene : scenes()) {
      const cmodel::Frame frame =
          driver::render_gaussians({scene, scene::project_all(scene), config}, {.unit = driver::Unit::Plain}).frame;
      const Picture picture = Chain(scene, config)(Mixture::all_device(), 2);
      ASSERT_EQ(frame.words.size(), picture.pixels.size() * 4);
      for (std::size_t i = 0; i < frame.words.size(); ++i) {
        ++words;
        light += frame.words[i] != 0 ? 1 : 0;
        different += std::ldexp(picture.pixels[i / 4][i % 4], frame.frac_bits) != frame.words[i] ? 1 : 0;
      }
    }
  }
  std::printf("[figure] words = %zu, not 0: %zu, different: %zu (limit 0)\n", words, light, different);
  EXPECT_EQ(different, 0u);
  EXPECT_GT(light, words / 4);
}

// Near a camera: footprints wider than a record's reach, and centres beyond it.
TEST(GaussianChain, ClipsAtTheReachOfARecordAsTheDeviceDoes) {
  scene::GaussianScene scene = scene_of("cloud:60", 1.0, scene::Projection::Orthographic);
  scene::GaussianDescription description = scene.description;
  description.width = 1300, description.height = 40, description.camera.zoom = 1000.0;
  scene = scene::build_gaussian_scene(description, scene.cloud);
  const cmodel::Config config = usual_config();
  const driver::GaussianRender device =
      driver::render_gaussians({scene, scene::project_all(scene), config}, {.unit = driver::Unit::Plain});
  const Chain chain(scene, config);
  const Picture picture = chain(Mixture::all_device(), 2), golden = chain(Mixture{}, 2);
  std::size_t different = 0, beyond = 0;
  double lost = 0.0;
  for (std::size_t i = 0; i < device.frame.words.size(); ++i) {
    const double value = std::ldexp(device.frame.words[i], -device.frame.frac_bits);
    different += picture.pixels[i / 4][i % 4] != value ? 1 : 0;
    lost = std::max(lost, std::abs(golden.pixels[i / 4][i % 4] - value));
  }
  for (const auto& one : chain.gaussians()->gaussians()) beyond += one.x < -502 || one.x > 1802 ? 1 : 0;
  std::printf(
      "[figure] words = %zu, different: %zu (limit 0); Gaussians clipped = %llu, centres beyond = %zu (limit > "
      "0); error = %.3g (limit > 0.01)\n",
      device.frame.words.size(), different, static_cast<unsigned long long>(device.report.cut), beyond, lost);
  EXPECT_EQ(different, 0u);
  EXPECT_GT(device.report.cut, 0u);
  EXPECT_GT(beyond, 0u);
  EXPECT_GT(lost, 0.01);
}

TEST(GaussianChain, AllRealIsGoldensPicture) {
  double worst = 0.0;
  const cmodel::Config config = usual_config();
  for (const scene::GaussianScene& scene : scenes()) {
    const Image image = golden::render_gaussians(scene, scene::project_all(scene));
    const Picture picture = Chain(scene, config)(Mixture{}, 2);
    for (std::size_t i = 0; i < image.data.size(); ++i)
      worst = std::max(worst, std::abs(picture.pixels[i / 4][i % 4] - static_cast<double>(image.data[i])));
  }
  // Golden's picture has floats: half a unit in the last place of values below 2.
  std::printf("[figure] largest difference = %.3g (limit %.3g)\n", worst, std::ldexp(1.0, -24));
  EXPECT_LE(worst, std::ldexp(1.0, -24));
  EXPECT_GT(worst, 0.0);
}

TEST(GaussianChain, AFollowedPixelIsThePicturesInEveryMixture) {
  const cmodel::Config config = usual_config();
  const scene::GaussianScene scene = scenes().front();
  const Chain chain(scene, config);
  fastsplat::test::Random random(7);
  std::size_t pixels = 0, different = 0, splats = 0;
  for (int turn = 0; turn < 12; ++turn) {
    const Mixture mixture = turn == 0 ? Mixture{} : turn == 1 ? Mixture::all_device() : test::random_mixture(random);
    const Picture picture = chain(mixture, 2);
    for (int i = 0; i < 12; ++i) {
      const int x = static_cast<int>(random.between(5, picture.width - 6)),
                y = static_cast<int>(random.between(5, picture.height - 6));
      const PixelTrace trace = PixelChain(chain, x, y, 1)(mixture);
      ++pixels;
      splats += trace.splats.size();
      different +=
          trace.out != picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + x] ? 1
                                                                                                                 : 0;
    }
  }
  std::printf("[figure] pixels = %zu, their Gaussians = %zu, different = %zu (limit 0)\n", pixels, splats, different);
  EXPECT_EQ(different, 0u);
  EXPECT_GT(splats, pixels);
}

TEST(GaussianChain, RefusesWhatTheDeviceCannotDraw) {
  const scene::GaussianScene scene = scenes().front();
  const cmodel::Config base = fastsplat::test::named_config("base");
  EXPECT_THROW(Chain(scene, base), UserError);
}

}  // namespace
}  // namespace fastsplat::stages
