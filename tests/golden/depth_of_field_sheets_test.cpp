// SPDX-License-Identifier: Apache-2.0
// Depth of field on sheets: the disc's moments, energy, pixels in focus, agreement with depth of field on splats.
#include "golden/depth_of_field_sheets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "density_helper.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::DepthOfField;

TEST(DiscFilter, HasTheEnergyAndTheSecondMomentOfItsDisc) {
  double energy = 0.0, moment = 0.0;
  for (const double c : {0.01, 0.3, 1.0, 1.7, 2.0, 5.0, 12.3, 60.0}) {
    const DiscFilter disc(c);
    double sum = 0.0, xx = 0.0, yy = 0.0;
    for (int y = -disc.reach(); y <= disc.reach(); ++y) {
      for (int x = -disc.reach(); x <= disc.reach(); ++x) {
        const double w = disc.half_row(y)[std::abs(x)];
        ASSERT_GE(w, 0.0);
        ASSERT_TRUE(w == 0.0 || std::abs(x) <= disc.row_reach(y));
        sum += w, xx += w * x * x, yy += w * y * y;
      }
    }
    energy = std::max(energy, std::abs(sum - 1.0));
    moment = std::max({moment, std::abs(xx / (c * c / 16.0) - 1.0), std::abs(yy / (c * c / 16.0) - 1.0)});
  }
  figure("disc_energy_error", energy, "limit 1e-12: sums of some thousand doubles");
  figure("disc_second_moment_error", moment, "of c^2/16; limit 1e-6");
  EXPECT_LE(energy, 1e-12);
  EXPECT_LE(moment, 1e-6);  // at c = 0.01 the moment is 6e-6 and the bisection ends at 2^-53 of the radius
}

TEST(DiscFilter, IsFlatInsideAndNothingOutside) {
  const DiscFilter disc(20.0);
  const double inside = disc.half_row(0)[0];
  EXPECT_NEAR(inside, 1.0 / (std::acos(-1.0) * 100.0), 0.01 * inside);  // a pixel's share of the area
  for (int y = -12; y <= 12; ++y) {
    for (int x = 0; x <= 12; ++x) {
      if (std::abs(y) > disc.reach() || x > disc.reach()) continue;
      const double w = disc.half_row(y)[x];
      EXPECT_NEAR(w, std::hypot(x, y) > 11.0 ? 0.0 : std::hypot(x, y) < 9.0 ? inside : w, 1e-15) << x << ' ' << y;
    }
  }
}

/// One voxel in the middle of a slab eight units deep that holds all of its kernel, at 4 mm from the centre.
DensityScene one_voxel(double opacity) {
  DensityScene what;
  what.dims = glm::ivec3(17);
  what.density = [](const glm::dvec3& mm) { return mm == glm::dvec3(0.0, -4.0, 0.0) ? 1.0 : 0.0; };
  what.points = {{0.5, {1.0, 0.5, 0.25}, 0.0}, {0.5, {1.0, 0.5, 0.25}, opacity}};
  what.pixels_per_mm = 6;
  what.width = what.height = 160;
  what.description.slab_width = 8.0;
  what.description.camera.azimuth = what.description.camera.elevation = 0.0;  // looks along -y
  what.description.camera.projection = scene::Projection::Perspective;
  return what;
}

double second_moment(const Image& image, int channel) {
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double v = image.pixel(x, y)[channel];
      sum += v, first += v * x, second += v * x * x;
    }
  }
  return second / sum - first / sum * (first / sum);
}

/// Focus so that a circle of `c` pixels lies at the depth of the voxel.
void blur(DensityScene& what, double c, DepthOfField kind) {
  scene::Lens& lens = what.description.lens;
  lens = {kind, 1.0, -10.0};
  lens.aperture = c / scene::circle_of_confusion(make_scene(what).camera, lens, 4.0);
}

TEST(DepthOfFieldSheets, SpreadsAPointAsTheDiscDoes) {
  for (const double c : {0.7, 3.0, 12.0}) {
    DensityScene what = one_voxel(0.4);
    const Image sharp = render(make_scene(what));
    blur(what, c, DepthOfField::Sheets);
    const Image soft = render(make_scene(what));
    // Rounding to float of some thousand values of up to 0.1, in random directions.
    double energy = 0.0;
    for (int channel = 0; channel < 4; ++channel) {
      energy = std::max(energy, std::abs(channel_sum(soft, channel) / channel_sum(sharp, channel) - 1.0));
    }
    const double spread = second_moment(soft, 3) - second_moment(sharp, 3);
    std::printf("c = %g pixels: ", c);
    figure("sheet_blur_energy_error", energy, "limit 1e-6");
    figure("sheet_blur_second_moment_over_c2_16", spread / (c * c / 16.0), "1 +- 1e-5");
    EXPECT_LE(energy, 1e-6);
    EXPECT_NEAR(spread / (c * c / 16.0), 1.0, 1e-5);
  }
}

TEST(DepthOfFieldSheets, InFocusNothingChanges) {
  DensityScene what = one_voxel(0.4);
  const Image sharp = render(make_scene(what));
  ASSERT_GT(max_opacity(sharp), 0.05);
  what.description.lens = {DepthOfField::Sheets, 50.0, 4.0};
  EXPECT_EQ(sharp, render(make_scene(what)));
  what.description.lens = {DepthOfField::Sheets, 0.0, -10.0};  // a pinhole
  EXPECT_EQ(sharp, render(make_scene(what)));
  what.description.lens = {DepthOfField::Sheets, 50.0, -4.0};  // the slab in front
  EXPECT_NE(sharp, render(make_scene(what)));
}

// A faint point in one plane. Both techniques spread it by the same second moment. A disc and a Gaussian differ from
// the fourth on: by R^4 / (48 sigma^4) of the peak for a disc of radius R = c/2 on a footprint of deviation sigma.
TEST(DepthOfFieldSheets, AgreesWithSplatsInOnePlane) {
  for (const double c : {2.0, 4.0, 8.0}) {
    DensityScene what = one_voxel(1e-4);
    blur(what, c, DepthOfField::Sheets);
    const Image sheets = render(make_scene(what));
    what.description.lens.depth_of_field = DepthOfField::Splats;
    const scene::Scene scene = make_scene(what);
    const Image splats = render(scene);
    const double sigma = scene.camera.scale_at(4.0) / std::sqrt(2.0 * what.a);
    const double expected = std::pow(0.5 * c / sigma, 4) / 48.0;
    const double difference = max_difference(sheets, splats) / max_opacity(sheets);
    std::printf("c = %g, footprint's deviation %.2f pixels, fourth moments %.2g: ", c, sigma, expected);
    figure("sheets_vs_splats_of_the_peak", difference, "limit: twice the fourth moment, and the cut at R");
    // The cut at R leaves a rim of exp(-aR^2) of the peak, which a wider splat has elsewhere.
    EXPECT_LE(difference, 2.0 * expected + 2.0 * std::exp(-what.a * what.radius * what.radius));
    EXPECT_NEAR(channel_sum(sheets, 3), channel_sum(splats, 3), 1e-3 * channel_sum(sheets, 3));
  }
}

TEST(DepthOfFieldSheets, ThreadsDoNotChangeABit) {
  DensityScene what;
  what.density = ball(7.0, 3.0);
  what.points = {{0.3, {0.9, 0.6, 0.4}, 0.0}, {0.7, {0.9, 0.6, 0.4}, 0.95}};
  what.shading = true;
  what.pixels_per_mm = 2;
  what.width = 71, what.height = 53;
  what.description.camera.projection = scene::Projection::Perspective;
  what.description.classify = scene::ClassifyOrder::Post;
  what.description.texture.kind = scene::SolidKind::Wood;
  what.description.bump.kind = scene::SolidKind::Noise;
  what.description.lens = {DepthOfField::Sheets, 30.0, -8.0};
  const scene::Scene scene = make_scene(what);
  const Image one = render(scene, {1, {}});
  ASSERT_GT(max_opacity(one), 0.5);
  for (const int threads : {2, 3, 0}) EXPECT_EQ(one, render(scene, {threads, {}})) << threads;
}

}  // namespace
}  // namespace fastsplat::golden::testing
