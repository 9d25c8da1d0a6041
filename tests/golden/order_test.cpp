// SPDX-License-Identifier: Apache-2.0
// Within a sheet the order of the splats does not matter; for splats composited one by one it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

Lattice turned_cube() {
  Lattice lattice;
  lattice.azimuth = 31;
  lattice.elevation = 20;
  return lattice;
}

/// All splats in another order: sheets are found by depth or by number, so only the order within sheets changes.
std::vector<scene::Splat> shuffled(std::vector<scene::Splat> splats) {
  std::mt19937 random(42);
  for (std::size_t i = splats.size(); i > 1; --i) std::swap(splats[i - 1], splats[random() % i]);
  return splats;
}

TEST(Order, DoesNotMatterWithinASheet) {
  for (const auto opacity : {scene::SlabOpacity::Additive, scene::SlabOpacity::Exponential}) {
    Lattice lattice = turned_cube();
    lattice.slab_opacity = opacity;
    const scene::Scene scene = make_scene(lattice);
    const std::vector<scene::Splat> splats = scene::collect_splats(scene);
    const std::vector<scene::Splat> permuted = shuffled(splats);
    ASSERT_GT(splats.size(), 1000u);
    for (const Method method : {Method::ImageAligned, Method::AxisAligned, Method::XRay}) {
      const Image a = render_splats(method, scene, splats);
      const Image b = render_splats(method, scene, permuted);
      // Sums of doubles in two orders differ by about 60 overlaps * 1.1e-16. A float pixel then differs by one rounding
      // at most, and most pixels are equal: a chance of about 60 * 2^-53 / 2^-24 each, times the sheets.
      const double largest = std::max(1.0, max_opacity(a));
      const double difference = max_difference(a, b) / largest;
      std::size_t differing = 0;
      for (std::size_t i = 0; i < a.data.size(); ++i) differing += a.data[i] != b.data[i];
      const std::string name = std::string(scene::to_string(method)) + "_" + scene::to_string(opacity);
      figure(name + "_permuted_difference", difference, "limit 1.2e-7: one float rounding");
      figure(name + "_permuted_values_differing", static_cast<double>(differing), "limit 1e-5 of the values");
      EXPECT_LE(difference, std::ldexp(1.0, -23));
      EXPECT_LE(differing, a.data.size() / 100000 + 1);
    }
  }
}

TEST(Order, MattersForWestover) {
  const scene::Scene scene = make_scene(turned_cube());
  std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const Image before = westover(scene, splats, {});
  // The same layers in the same order; only the order inside each layer is reversed.
  const auto same_layer = [](const scene::Splat& a, const scene::Splat& b) { return a.sheet < b.sheet; };
  std::reverse(splats.begin(), splats.end());
  std::stable_sort(splats.begin(), splats.end(), same_layer);
  const double difference = max_difference(before, westover(scene, splats, {}));
  figure("westover_layer_order_difference", difference, "more than 0.01");
  EXPECT_GT(difference, 0.01);
}

// Adding a layer's opacities gives the layer's opacity, flat up to the kernel's ripple; compositing them one by one
// gives less: c1+c2 > c1+c2(1-a1).
TEST(Order, CompositingOverlapsInsteadOfAddingLosesOpacity) {
  Lattice lattice;
  lattice.dims = {19, 1, 19};
  lattice.optical_depth = 0.6;
  lattice.pixels_per_mm = 16;
  lattice.width = lattice.height = 129;
  lattice.slab_opacity = scene::SlabOpacity::Additive;
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const auto range = [](const Image& image) {
    double low = 1, high = 0;
    for (int y = 16; y < 112; ++y) {
      for (int x = 16; x < 112; ++x) {
        low = std::min<double>(low, image.pixel(x, y)[3]);
        high = std::max<double>(high, image.pixel(x, y)[3]);
      }
    }
    return std::pair(low, high);
  };
  const auto [sheet_low, sheet_high] = range(axis_aligned(scene, splats, {}));
  const auto [each_low, each_high] = range(westover(scene, splats, {}));
  figure("layer_opacity_added_low", sheet_low, "0.6 - 2.9 %");
  figure("layer_opacity_added_high", sheet_high, "0.6 + 2.9 %");
  figure("layer_opacity_composited_high", each_high, "below every added one");
  EXPECT_NEAR(sheet_low, 0.6, 0.6 * 0.029);
  EXPECT_NEAR(sheet_high, 0.6, 0.6 * 0.029);
  EXPECT_LT(each_high, sheet_low);
  EXPECT_GT(each_low, 0.3);
}

}  // namespace
}  // namespace fastsplat::golden::testing
