// SPDX-License-Identifier: Apache-2.0
// Solid textures and bumps: sharp for any voxel size if made at pixels, fixed to the object, without effect at
// amplitude 0.
#include "golden/solid_textures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "density_helper.hpp"
#include "golden/bump_mapping.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::ClassifyOrder;
using scene::SolidKind;
using scene::TextureWhere;

/// A white block of 64 x 16 x 64 mm, seen along y, with voxels of a given size.
DensityScene block(double voxel) {
  DensityScene what;
  what.dims = glm::ivec3(glm::round(glm::dvec3(64, 16, 64) / voxel));
  what.spacing = glm::dvec3(voxel);
  what.density = [](const glm::dvec3&) { return 1.0; };
  what.points = {{0.0, {1, 1, 1}, 0.99}};
  what.pixels_per_mm = 3;
  what.width = 192;
  what.height = 9;
  what.description.camera.azimuth = what.description.camera.elevation = 0.0;
  return what;
}

/// Amplitude of the wave of `length` pixels in the middle row's red, over whole waves of the middle of the picture.
double wave_amplitude(const Image& image, double length) {
  const int waves = static_cast<int>(image.width / 2 / length);
  const int count = static_cast<int>(std::lround(waves * length));
  const int first = (image.width - count) / 2;
  double c = 0.0, s = 0.0;
  for (int x = first; x < first + count; ++x) {
    const double phase = 2.0 * std::numbers::pi * x / length;
    const float red = image.pixel(x, image.height / 2)[0] / image.pixel(x, image.height / 2)[3];
    c += red * std::cos(phase), s += red * std::sin(phase);
  }
  return 2.0 * std::hypot(c, s) / count;
}

// N-8-18 at voxels, and N-8-106, N-8-107 for stripes. A stripe's tint is a wave of amplitude 0.4 about 0.6. At pixels
// it must arrive whole for any voxel size. At voxels the kernel blurs it. For voxels of h and waves of L its spectrum
// is exp(-pi^2 (h/L)^2 / a), which the cut at R moves by at most exp(-a R^2).
TEST(SolidTexture, AtPixelsItDoesNotDependOnTheVoxels) {
  constexpr double kWave = 12.0;  // mm
  for (const double voxel : {1.0, 2.0, 4.0}) {
    DensityScene what = block(voxel);
    what.description.texture = {SolidKind::Stripes, TextureWhere::Pixel, kWave, 1.0};
    const double pixels = wave_amplitude(render(make_scene(what)), kWave * what.pixels_per_mm);
    what.description.classify = ClassifyOrder::Post;
    const double post = wave_amplitude(render(make_scene(what)), kWave * what.pixels_per_mm);
    what.description.classify = ClassifyOrder::Pre;
    what.description.texture.where = TextureWhere::Voxel;
    const double voxels = wave_amplitude(render(make_scene(what)), kWave * what.pixels_per_mm);
    const double blurred = 0.4 * std::exp(-std::pow(std::numbers::pi * voxel / kWave, 2) / what.a);
    const std::string size = std::to_string(static_cast<int>(voxel)) + "mm";
    figure("stripes_at_pixels_" + size, pixels, "0.4 whatever the voxel");
    figure("stripes_at_pixels_post_" + size, post, "0.4 whatever the voxel");
    std::printf("blurred by the kernel %.4f: ", blurred);
    figure("stripes_at_voxels_" + size, voxels, "0.4 times the kernel's spectrum");
    EXPECT_NEAR(pixels, 0.4, 1e-6);
    EXPECT_NEAR(post, 0.4, 1e-6);
    EXPECT_NEAR(voxels, blurred, 0.4 * 0.01);
  }
}

// Points of a ball, found in two pictures of it: the tint at one azimuth is the tint at the other, up to the width of a
// pixel and of the edge. A texture fixed to the picture would differ by the control.
TEST(SolidTexture, TurnsWithTheObject) {
  for (const auto order : {ClassifyOrder::Pre, ClassifyOrder::Post}) {
    DensityScene what;
    what.density = ball(7.0, 1.0);
    what.points = step_at(0.5);
    what.pixels_per_mm = 5;
    what.width = what.height = 96;
    what.description.slab_width = 0.25;
    what.description.classify = order;
    what.description.texture = {SolidKind::Stripes, TextureWhere::Pixel, 10.0, 1.0};
    what.description.camera.elevation = 25.0;
    what.description.camera.azimuth = -20.0;
    const scene::Scene left = make_scene(what);
    what.description.camera.azimuth = 20.0;
    const scene::Scene right = make_scene(what);
    const Image a = render(left), b = render(right);
    double moved = 0.0, control = 0.0;
    for (int i = -40; i <= 40; ++i) {
      for (int j = -40; j <= 40; ++j) {
        // The half of the ball that faces the middle of both views, as the step edge places its surface.
        const double turn = i * 0.01, tip = j * 0.01 + 0.4;
        const glm::dvec3 point =
            7.0 * glm::dvec3(std::sin(turn) * std::cos(tip), std::cos(turn) * std::cos(tip), std::sin(tip));
        const auto red = [&](const scene::Scene& scene, const Image& image) {
          const scene::ScreenPoint at = scene.camera.project(point);
          return image.pixel(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)))[0];
        };
        moved += std::abs(red(left, a) - red(right, b));
        control += std::abs(red(left, a) - red(right, a));
      }
    }
    const char* name = order == ClassifyOrder::Pre ? "pre" : "post";
    figure(std::string("texture_moved_on_the_object_") + name, moved / control,
           "limit 0.3 of a texture on the picture");
    EXPECT_GT(control / (81 * 81), 0.05);
    EXPECT_LT(moved, 0.3 * control);
  }
}

DensityScene lit_ball() {
  DensityScene what;
  what.dims = {20, 18, 22};
  what.density = ball(6.5, 3.0);
  what.points = {{0.3, {0.9, 0.6, 0.4}, 0.0}, {0.7, {0.9, 0.6, 0.4}, 0.95}};
  what.shading = true;
  what.width = what.height = 96;
  what.description.camera.azimuth = 31;
  what.description.camera.elevation = 20;
  return what;
}

TEST(SolidTexture, AmplitudeZeroMeansWithoutTexture) {
  int compared = 0;
  for (const auto order : {ClassifyOrder::Pre, ClassifyOrder::Post}) {
    for (const auto where : {TextureWhere::Voxel, TextureWhere::Pixel}) {
      if (order == ClassifyOrder::Post && where == TextureWhere::Voxel) continue;
      DensityScene what = lit_ball();
      what.description.classify = order;
      const Image plain = render(make_scene(what));
      ASSERT_GT(max_opacity(plain), 0.9);
      for (const auto kind : {SolidKind::Checker, SolidKind::Marble, SolidKind::Wood}) {
        what.description.texture = {kind, where, 3.0, 0.0};
        EXPECT_EQ(plain, render(make_scene(what)));
        what.description.texture.amplitude = 0.01;
        EXPECT_NE(plain, render(make_scene(what)));
        ++compared;
      }
    }
  }
  figure("textures_of_amplitude_0_equal_to_none", compared, "9, bit for bit");
}

// N-8-109.
TEST(BumpMapping, LeansTheNormalAlongThePattern) {
  // Stripes B = (1 + cos 2 pi x/L)/2 on a plane that faces z: the normal leans by -b pi sin(2 pi x/L) along x.
  const scene::Bump bump{SolidKind::Stripes, 5.0, 0.4};
  double worst = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.07 * i;
    PixelSample sample{{x, 1.0, 2.0}, {0.0, 0.0, 3.0}, glm::dvec3(1.0)};
    BumpMapping(bump).apply(sample);
    const double lean = -0.4 * std::numbers::pi * std::sin(2.0 * std::numbers::pi * x / 5.0);
    worst = std::max(worst, glm::length(sample.gradient / 3.0 - glm::dvec3(lean, 0.0, 1.0)));
    // Along the normal the pattern changes nothing.
    PixelSample along{{x, 1.0, 2.0}, {2.0, 0.0, 0.0}, glm::dvec3(1.0)};
    BumpMapping(bump).apply(along);
    worst = std::max(worst, glm::length(along.gradient - glm::dvec3(2.0, 0.0, 0.0)));
  }
  // The pattern's slope is a difference over 1/64: (2 pi/64)^2/6 of it is lost.
  figure("bump_lean_error", worst, "limit 0.4 pi (2 pi/64)^2 / 6 = 0.0021");
  EXPECT_LE(worst, 0.4 * std::numbers::pi * std::pow(2.0 * std::numbers::pi / 64.0, 2) / 6.0);
}

TEST(BumpMapping, ChangesTheLightOnlyAndNothingAtAmplitudeZero) {
  for (const auto gradients : {scene::GradientKind::Central, scene::GradientKind::Splats}) {
    DensityScene what = lit_ball();
    what.description.classify = ClassifyOrder::Post;
    what.description.gradients = gradients;
    const Image plain = render(make_scene(what));
    for (const auto kind : {SolidKind::Stripes, SolidKind::Noise}) {
      what.description.bump = {kind, 2.0, 0.0};
      EXPECT_EQ(plain, render(make_scene(what)));
      what.description.bump.amplitude = 0.5;
      const Image bumpy = render(make_scene(what));
      double light = 0.0;
      for (std::size_t i = 0; i < plain.data.size(); i += 4) {
        ASSERT_EQ(plain.data[i + 3], bumpy.data[i + 3]) << "a bump moved the surface";
        light = std::max<double>(light, std::abs(plain.data[i] - bumpy.data[i]));
      }
      figure("bumps_change_light_by", light, "more than 0.1; opacity bit for bit the same");
      EXPECT_GT(light, 0.1);
    }
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
