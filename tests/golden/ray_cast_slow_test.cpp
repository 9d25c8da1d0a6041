// SPDX-License-Identifier: Apache-2.0
// The ray caster at working size: a volume of real extent and structure, against thin and working slabs.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "scene/volume/synthetic.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

TEST(RayCastSlow, ShellsAgainstSlabs) {
  scene::SceneDescription description;
  description.width = description.height = 256;
  description.shading = 0;
  const auto volume = std::make_shared<volume::Volume>(volume::make_synthetic("shells", 64));
  scene::Scene scene = scene::build_scene(description, volume);
  // Colours that change with depth inside each shell, so that the picture shows the order.
  scene.transfer_function = {};
  scene.transfer_function.domain = scene::Domain::Value;
  scene.transfer_function.points = {{0.05, {0.0, 0.0, 0.0}, 0.0},
                                    {0.3, {1.0, 0.2, 0.1}, 0.2},
                                    {0.6, {0.1, 0.9, 0.3}, 0.3},
                                    {1.0, {0.2, 0.3, 1.0}, 0.5}};
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  ASSERT_GT(splats.size(), 10000u);

  const auto start = std::chrono::steady_clock::now();
  const Image reference = ray_cast(scene, {});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_GT(max_opacity(reference), 0.5);
  std::printf("%zu splats at 256 x 256: %.2f s\n", splats.size(), seconds);

  std::vector<double> widths = {1.0, 0.5, 0.25, 0.125};
  std::vector<double> errors;
  for (const double width : widths) {
    scene.description.slab_width = width;
    errors.push_back(rms_difference(image_aligned(scene, splats, {}), reference));
  }
  const double order = fitted_order(widths, errors);
  figure("shells_rms_at_W1", errors.front(), "recorded");
  figure("shells_order_exponential", order, "2.0 +- 0.3");
  EXPECT_NEAR(order, 2.0, 0.3);

  // Second order from the error at W=1/8 down to 1/64, the ray's own step of 1/32 included; cut at R and float as in
  // convergence_test.cpp.
  scene.description.slab_width = 0.125;
  const double coarse = max_difference(image_aligned(scene, splats, {}), reference);
  scene.description.slab_width = 1.0 / 64;
  const double fine = max_difference(image_aligned(scene, splats, {}), reference);
  const double bound = 2 * coarse * (1.0 / 64 + 1.0 / 16) + 2 * std::exp(-8.0) / 32 * 0.8 + std::ldexp(1.0, -23);
  std::printf("W=1/8: %.3g, bound at W=1/64 %.3g: ", coarse, bound);
  figure("shells_thin_slabs_vs_rays", fine, "second order of both, cut at R, float");
  EXPECT_LE(fine, bound);
}

}  // namespace
}  // namespace fastsplat::golden::testing
