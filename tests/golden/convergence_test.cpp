// SPDX-License-Identifier: Apache-2.0
// Slabs against the ray caster: first order in the slab width when opacities are added, second order when the slab dims
// itself exponentially. The two sides share neither loops nor projection.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::SlabOpacity;

constexpr double kRayStep = 1.0 / 32;  // docs/golden.md, "Ray casting"

Lattice turned_cube(double optical_depth) {
  Lattice lattice;
  lattice.dims = glm::ivec3(12);
  lattice.optical_depth = optical_depth;
  lattice.azimuth = 31;
  lattice.elevation = 20;
  lattice.pixels_per_mm = 4;
  lattice.width = lattice.height = 104;
  return lattice;
}

Image slabs(Lattice lattice, double width) {
  lattice.slab_width = width;
  const scene::Scene scene = make_scene(lattice);
  return image_aligned(scene, scene::collect_splats(scene), {});
}

/// Prints the row of the table and returns the order fitted over slab widths 1 to 1/8.
double measure_order(Lattice lattice, const Image& reference) {
  std::vector<double> widths, errors;
  std::printf("%-11s tau %-4g rms error:", scene::to_string(lattice.slab_opacity), lattice.optical_depth);
  for (const double width : {4.0, 2.0, 1.0, 0.5, 0.25, 0.125}) {
    const double error = rms_difference(slabs(lattice, width), reference);
    std::printf("  W=%g %.4f%%", width, 100 * error);
    if (width <= 1.0) {
      widths.push_back(width);
      errors.push_back(error);
    }
  }
  const double order = fitted_order(widths, errors);
  std::printf("  order %.2f\n", order);
  return order;
}

TEST(Convergence, OrderInTheSlabWidth) {
  for (const double tau : {0.1, 0.6}) {
    Lattice lattice = turned_cube(tau);
    const Image reference = ray_cast(make_scene(lattice), {});
    ASSERT_GT(max_opacity(reference), 0.5);

    lattice.slab_opacity = SlabOpacity::Additive;
    const double added = measure_order(lattice, reference);
    figure("order_additive_tau_" + std::to_string(tau).substr(0, 3), added, "1.0 +- 0.1");
    EXPECT_NEAR(added, 1.0, 0.1);

    lattice.slab_opacity = SlabOpacity::Exponential;
    const double exponential = measure_order(lattice, reference);
    figure("order_exponential_tau_" + std::to_string(tau).substr(0, 3), exponential, "2.0 +- 0.3");
    EXPECT_NEAR(exponential, 2.0, 0.3);
  }
}

// The limit of thin slabs is the ray caster's picture. Both discretisations are of second order. From the error e at
// W=1 there remain e W^2 for the slabs and e step^2 for the rays, doubled for the higher orders. The ray's samples of
// the kernel cut at R miss at most exp(-aR^2) step sqrt(a/pi) of a splat's optical depth, which moves a pixel by at
// most twice that (splatting.md section 5 item 6). Both images are rounded to float.
void expect_agreement(Lattice lattice, const char* name) {
  const Image reference = ray_cast(make_scene(lattice), {});
  ASSERT_GT(max_opacity(reference), 0.5);
  const double coarse = max_difference(slabs(lattice, 1.0), reference);
  const double width = 1.0 / 64;
  const double fine = max_difference(slabs(lattice, width), reference);
  const double cut =
      std::exp(-lattice.a * lattice.radius * lattice.radius) * kRayStep * std::sqrt(lattice.a / std::numbers::pi);
  const double bound = 2 * coarse * (width * width + kRayStep * kRayStep) + 2 * cut + std::ldexp(1.0, -23);
  std::printf("W=1: %.3g, bound at W=1/64 %.3g: ", coarse, bound);
  figure(name, fine, "second order of both, cut at R, float");
  EXPECT_LE(fine, bound);
}

TEST(Convergence, ThinSlabsAgreeWithRays) { expect_agreement(turned_cube(0.6), "thin_slabs_vs_rays"); }

TEST(Convergence, ThinSlabsAgreeWithRaysInPerspective) {
  Lattice lattice = turned_cube(0.6);
  lattice.projection = scene::Projection::Perspective;
  lattice.fov = 60;
  lattice.pixels_per_mm = 3;
  expect_agreement(lattice, "thin_slabs_vs_rays_perspective");
}

TEST(Convergence, ThinSlabsAgreeWithRaysOnAnAnisotropicGrid) {
  Lattice lattice = turned_cube(0.6);
  lattice.dims = {20, 14, 10};
  lattice.spacing = {0.5, 1.0, 1.5};
  lattice.a = 1.35;
  lattice.roll = 40;
  expect_agreement(lattice, "thin_slabs_vs_rays_anisotropic");
}

TEST(Convergence, WideKernelsDoNotUnderflowAlongTheRay) {
  Lattice lattice = turned_cube(0.6);
  lattice.dims = glm::ivec3(4);
  lattice.a = 20;  // with R = 8 the rim is exp(-1280) of the peak
  lattice.radius = 8;
  lattice.optical_depth = 3;
  lattice.width = lattice.height = 32;
  const Image reference = ray_cast(make_scene(lattice), {});
  ASSERT_GT(max_opacity(reference), 0.5);
  const double coarse = max_difference(slabs(lattice, 0.25), reference);
  const double fine = max_difference(slabs(lattice, 1.0 / 64), reference);
  figure("wide_kernel_difference", fine, "second order: (4/64)^2 + (4/32)^2 of the difference at W=1/4, doubled");
  EXPECT_LE(fine, 2 * coarse * (1.0 / 256 + 1.0 / 64) + std::ldexp(1.0, -23));
}

}  // namespace
}  // namespace fastsplat::golden::testing
