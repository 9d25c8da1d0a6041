// SPDX-License-Identifier: Apache-2.0
// The decks' claims, measured on the integer device: no popping between image-aligned slabs, convergence with their
// width.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using scene::Method;

/// A tilted cube whose faces differ by shading. A one-coloured cube about one axis is mirror-symmetric at 45 degrees
/// and cannot pop (splatting.md, section 2, item 3).
Image cube(Method method, double width, double azimuth) {
  auto description = view_of("binary-cube:32", 128, "binary");
  description.method = method;
  description.slab_width = width;
  description.shading = 1;
  description.camera.elevation = 20.0;
  description.camera.azimuth = azimuth;
  description.camera.zoom = 1.0;
  return to_image(render(scene::build_scene(description), load_config("base")).frame);
}

double popping(Method method, double width) {
  const Image a = cube(method, width, 44.2), b = cube(method, width, 44.7), c = cube(method, width, 45.2);
  return distance(b, c).rms / distance(a, b).rms;
}

TEST(Claims, the_integer_device_pops_with_axis_aligned_sheets_only) {
  const double axis = popping(Method::AxisAligned, 1.0);
  figure("popping metric, axis-aligned", axis);
  EXPECT_GE(axis, 3.0);
  for (const double width : {0.5, 1.0, 2.0}) {
    const double image = popping(Method::ImageAligned, width);
    figure("popping metric, image-aligned, slab width " + std::to_string(width), image);
    EXPECT_GE(image, 0.95);
    EXPECT_LE(image, 1.05);
  }
}

}  // namespace
}  // namespace fastsplat::driver
