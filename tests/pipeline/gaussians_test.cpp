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
#include "tests/pipeline/oracle/rounding.hpp"

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

/// docs/floats.md, pixel by pixel.
Picture as_floats(const scene::GaussianScene& scene, const cmodel::Config& config, const FloatNumbers& numbers) {
  oracle::Closeness ignored;
  const auto n = [&](double v) { return oracle::to_float(numbers.operands, numbers.subnormals, v, ignored); };
  const auto s = [&](double v) { return oracle::to_float(numbers.sums, numbers.subnormals, v, ignored); };
  const auto gaussians = scene::project_all(scene);
  const double rim = scene.description.cutoff * scene.description.cutoff;
  Picture out{scene.camera.width(), scene.camera.height(), {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      golden::Sums pixel{0.0, 0.0, 0.0, 1.0};
      for (const scene::ProjectedGaussian& one : gaussians) {
        if (pixel[3] < scene::kFinished) break;
        const double centre_x = numbers.tile_centres ? one.x : n(one.x),
                     centre_y = numbers.tile_centres ? one.y : n(one.y);
        if (std::abs(x - centre_x) > std::sqrt(rim * one.shape.xx) ||
            std::abs(y - centre_y) > std::sqrt(rim * one.shape.yy))
          continue;
        const auto offset = [&](int pixel_at, double centre, double real, int tile) {
          const int corner = pixel_at / tile * tile;
          return numbers.tile_centres ? n(pixel_at - corner - n(real - corner)) : n(pixel_at - centre);
        };
        const double dx = offset(x, centre_x, one.x, config.tile_width),
                     dy = offset(y, centre_y, one.y, config.tile_height);
        const double xx = rim * one.shape.xx, xy = rim * one.shape.xy, yy = rim * one.shape.yy,
                     determinant = xx * yy - xy * xy;
        const double mixed = n(n(-2.0 * xy / determinant) * n(dx * dy));
        const double u = n(n(n(n(yy / determinant) * n(dx * dx)) + mixed) + n(n(xx / determinant) * n(dy * dy)));
        if (!(u < 1.0)) continue;
        const double w = n(std::exp(-0.5 * rim * std::max(u, 0.0)));
        const double opacity = n(w * n(one.opacity));
        for (std::size_t c = 0; c < 3; ++c)
          pixel[c] = s(pixel[c] + n(pixel[3] * n(w * n(one.opacity * one.colour[static_cast<int>(c)]))));
        pixel[3] = n(pixel[3] * n(1.0 - opacity));
      }
      for (std::size_t c = 0; c < 4; ++c) pixel[c] = n(c < 3 ? pixel[c] : 1.0 - pixel[c]);
      out.pixels.push_back(pixel);
    }
  }
  return out;
}

TEST(GaussianChain, AllFloatsIsThePageValueByValue) {
  cmodel::Config config = usual_config();
  config.tile_width = 32, config.tile_height = 24;
  fastsplat::test::Random random(2180);
  std::size_t values = 0, different = 0, light = 0, beside = 0;
  for (int turn = 0; turn < 16; ++turn) {
    const scene::GaussianScene scene = scenes()[static_cast<std::size_t>(turn) % 4];
    const FloatNumbers numbers = turn == 0 ? FloatNumbers{} : test::random_floats(random);
    const Chain chain(scene, config);
    const Picture picture = chain(Mixture::all_floats(numbers), 2), golden = chain(Mixture{}, 2),
                  expected = as_floats(scene, config, numbers);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) {
        const double here = picture.pixels[i][c], there = expected.pixels[i][c];
        ++values;
        light += there != 0.0 ? 1 : 0;
        different += here == there || (std::isnan(here) && std::isnan(there)) ? 0 : 1;
        beside += here != golden.pixels[i][c] ? 1 : 0;
      }
    }
  }
  std::printf("[figure] values = %zu, not 0: %zu, beside golden: %zu, different from the page: %zu (limit 0)\n", values,
              light, beside, different);
  EXPECT_EQ(different, 0u);
  EXPECT_GT(light, values / 4);
  EXPECT_GT(beside, values / 4);
}

TEST(GaussianChain, AFollowedPixelIsThePicturesInEveryMixture) {
  const cmodel::Config config = usual_config();
  const scene::GaussianScene scene = scenes().front();
  const Chain chain(scene, config);
  fastsplat::test::Random random(7);
  std::size_t pixels = 0, different = 0, splats = 0;
  for (int turn = 0; turn < 12; ++turn) {
    const Mixture mixture = turn == 0       ? Mixture{}
                            : turn == 1     ? Mixture::all_device()
                            : turn % 2 == 0 ? test::random_mixture(random)
                                            : test::random_mixture_with_floats(random);
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
