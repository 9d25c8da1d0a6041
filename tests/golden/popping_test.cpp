// SPDX-License-Identifier: Apache-2.0
// Turning past 45 degrees flips the dominant axis: axis-aligned sheets pop, image-aligned ones must not. P =
// rms(I(45.2)-I(44.7)) / rms(I(44.7)-I(44.2)); a picture that only turns has P = 1.
#include <gtest/gtest.h>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;
using scene::SlabOpacity;

// The cube of splatting.md section 2 item 3: 16^3, 4 pixels a voxel, opacity .6 a voxel. Tilted and graded in colour: a
// cube of one colour seen level is mirror-symmetric about 45 degrees and cannot pop.
Lattice cube(SlabOpacity opacity) {
  Lattice lattice;
  lattice.dims = glm::ivec3(16);
  lattice.optical_depth = 0.6;  // added, it is the opacity
  lattice.elevation = 20;
  lattice.pixels_per_mm = 4;
  lattice.slab_opacity = opacity;
  return lattice;
}

double popping(Lattice lattice, Method method) {
  Image images[3];
  const double azimuths[3] = {44.2, 44.7, 45.2};
  for (int i = 0; i < 3; ++i) {
    lattice.azimuth = azimuths[i];
    scene::Scene scene = make_scene(lattice);
    scene.description.method = method;
    images[i] = render(scene);
  }
  return rms_difference(images[2], images[1]) / rms_difference(images[1], images[0]);
}

TEST(Popping, DominantAxisFlipsBetweenTheViews) {
  Lattice lattice = cube(SlabOpacity::Additive);
  glm::dvec3 direction[2];
  for (int i = 0; i < 2; ++i) {
    lattice.azimuth = i == 0 ? 44.7 : 45.2;
    direction[i] = glm::abs(make_scene(lattice).camera.direction());
  }
  EXPECT_NE(direction[0].x > direction[0].y, direction[1].x > direction[1].y);
}

TEST(Popping, AxisAlignedPops) {
  const double added = popping(cube(SlabOpacity::Additive), Method::AxisAligned);
  figure("popping_axis_aligned_additive", added, "at least 3");
  EXPECT_GE(added, 3.0);
  // Exponential sheets compensate for the longer path through an oblique sheet: they pop less, but they pop.
  const double exponential = popping(cube(SlabOpacity::Exponential), Method::AxisAligned);
  figure("popping_axis_aligned_exponential", exponential, "above 2, less than additive");
  EXPECT_GT(exponential, 2.0);
  EXPECT_LT(exponential, added);
}

TEST(Popping, ImageAlignedDoesNotPop) {
  for (const SlabOpacity opacity : {SlabOpacity::Additive, SlabOpacity::Exponential}) {
    for (const double width : {0.5, 1.0, 2.0}) {
      Lattice lattice = cube(opacity);
      lattice.slab_width = width;
      const double p = popping(lattice, Method::ImageAligned);
      figure(
          std::string("popping_image_aligned_") + scene::to_string(opacity) + "_W" + std::to_string(width).substr(0, 3),
          p, "0.95 to 1.05");
      EXPECT_GE(p, 0.95);
      EXPECT_LE(p, 1.05);
    }
  }
}

TEST(Popping, RayCasterDoesNotPop) {
  const double p = popping(cube(SlabOpacity::Exponential), Method::RayCast);
  figure("popping_ray_cast", p, "0.95 to 1.05");
  EXPECT_GE(p, 0.95);
  EXPECT_LE(p, 1.05);
}

}  // namespace
}  // namespace fastsplat::golden::testing
