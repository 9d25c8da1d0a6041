// SPDX-License-Identifier: Apache-2.0
// Depth of field on splats: the plane in focus unchanged, all else spread as a disc of its circle of confusion.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

/// Looks exactly along -y, so that a layer y = const is all at one depth, bit for bit.
Lattice front_view() {
  Lattice lattice;
  lattice.dims = {12, 12, 12};
  lattice.projection = scene::Projection::Perspective;
  lattice.fov = 50;
  lattice.pixels_per_mm = 5;
  lattice.width = lattice.height = 128;
  return lattice;
}

scene::Scene through_lens(scene::Scene scene, double aperture, double focus) {
  scene.description.lens = {scene::DepthOfField::Splats, aperture, focus};
  return scene;
}

TEST(DepthOfField, PixelsInFocusKeepEveryBit) {
  const scene::Scene pinhole = make_scene(front_view());
  std::vector<scene::Splat> layer;
  for (const scene::Splat& splat : scene::collect_splats(pinhole)) {
    if (splat.position.y == -2.5f) layer.push_back(splat);
  }
  ASSERT_EQ(layer.size(), 144u);
  for (const Method method : {Method::XRay, Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
    const Image sharp = render_splats(method, pinhole, layer);
    ASSERT_GT(max_opacity(sharp), 0.1);
    EXPECT_EQ(sharp, render_splats(method, through_lens(pinhole, 20, 2.5), layer)) << scene::to_string(method);
    EXPECT_NE(sharp, render_splats(method, through_lens(pinhole, 20, 2.4), layer)) << scene::to_string(method);
    // A pinhole focuses everything.
    const std::vector<scene::Splat> all = random_splats(pinhole, 200, 2.0, 5);
    EXPECT_EQ(render_splats(method, pinhole, all), render_splats(method, through_lens(pinhole, 0, 1), all));
  }
}

// A disc of diameter c has the second moment c^2/16 along each axis: (c/2)^2/2 is its mean squared radius.
TEST(DepthOfField, PointSpreadAndEnergy) {
  Lattice lattice = front_view();
  lattice.pixels_per_mm = 24;  // the finer the pixels, the narrower the bound
  lattice.width = lattice.height = 512;
  const scene::Scene pinhole = make_scene(lattice);
  int compared = 0;
  for (const float y : {-5.5f, -1.0f, 2.0f, 5.5f}) {
    const std::vector<scene::Splat> one = {{glm::vec3(0.4f, y, -0.3f), glm::vec3(1), 1.0f, 0}};
    const scene::Scene lens = through_lens(pinhole, 8, 1.0);
    const Moments before = moments(xray(pinhole, one, {}), 3), after = moments(xray(lens, one, {}), 3);
    const double c = scene::circle_of_confusion(lens.camera, lens.description.lens, -static_cast<double>(y));
    const double s = lens.camera.scale_at(-static_cast<double>(y));
    const double bound = 2 * sampling_bound(lattice.a, lattice.radius, s);
    if (c == 0.0) {
      EXPECT_EQ(before.xx, after.xx);
      continue;
    }
    const std::string at = "depth_" + std::to_string(static_cast<int>(-y));
    std::printf("c = %.3f px: ", c);
    figure(at + "_energy_error", after.sum / before.sum - 1, "sampling ripple and rim");
    figure(at + "_second_moment_x_over_c2_16", (after.xx - before.xx) / (c * c / 16), "1");
    figure(at + "_second_moment_y_over_c2_16", (after.yy - before.yy) / (c * c / 16), "1");
    EXPECT_NEAR(after.sum, before.sum, bound * before.sum);
    // The rim's step weighs (R s)^2 in a second moment, which is 1/(2a) s^2 without the cut.
    const double moment_bound = bound * lattice.radius * lattice.radius * 2 * lattice.a * after.xx;
    EXPECT_NEAR(after.xx - before.xx, c * c / 16, moment_bound);
    EXPECT_NEAR(after.yy - before.yy, c * c / 16, moment_bound);
    EXPECT_LT(moment_bound, 0.03 * c * c / 16) << "the bound must be worth something";
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

// The total over a whole volume is preserved too.
TEST(DepthOfField, EnergyOfAVolume) {
  Lattice lattice = front_view();
  lattice.azimuth = 31;
  lattice.elevation = 20;
  const scene::Scene pinhole = make_scene(lattice);
  const std::vector<scene::Splat> splats = random_splats(pinhole, 300, 1.0, 13);
  const double before = channel_sum(xray(pinhole, splats, {}), 3);
  const double after = channel_sum(xray(through_lens(pinhole, 4, -2), splats, {}), 3);
  figure("depth_of_field_energy_error", after / before - 1, "sampling ripple and rim");
  EXPECT_NEAR(after, before, before * 2 * sampling_bound(lattice.a, lattice.radius, 3.5));
  EXPECT_NE(after, before);
}

}  // namespace
}  // namespace fastsplat::golden::testing
