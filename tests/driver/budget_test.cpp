// SPDX-License-Identifier: Apache-2.0
// The error budget: the integer image against the floating-point one. Separate from bit-exactness.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using scene::Method;

Lsb8 measure(const scene::SceneDescription& description, const std::string& config) {
  const auto scene = scene::build_scene(description);
  const auto device = render(scene, load_config(config));
  EXPECT_EQ(device.report.saturated_voxels + device.report.saturated_records, 0u);
  EXPECT_EQ(device.counters.snap_saturated + device.counters.sheet_saturated, 0u);
  const Image reference = golden::render(scene);
  double lit = 0.0;
  for (const float value : reference.data) lit = std::max(lit, static_cast<double>(value));
  // An automatic X-ray exposure leaves room for a ray through only the densest material; the rays of shells are
  // thinner.
  EXPECT_GT(lit, description.method == Method::XRay ? 0.05 : 0.2) << "a dark picture compares nothing";
  const Lsb8 apart = distance(reference, to_image(device.frame));
  const std::string what = std::string(scene::to_string(description.method)) + " " + description.volume + " " + config;
  figure(what + ": max", apart.largest, "LSB8");
  figure(what + ": PSNR", apart.psnr_db, "dB");
  return apart;
}

TEST(Budget, base_holds_three_lsb8_and_48_db_in_every_method) {
  for (const Method method : {Method::ImageAligned, Method::AxisAligned, Method::XRay}) {
    for (const char* volume : {"shells:32", "marschner-lobb:32"}) {
      auto description = view_of(volume, 128);
      description.method = method;
      const Lsb8 apart = measure(description, "base");
      EXPECT_LE(apart.largest, 3.0);
      EXPECT_GE(apart.psnr_db, 48.0);
    }
  }
}

TEST(Budget, base_holds_it_additive_thin_thick_and_in_perspective) {
  for (const auto opacity : {scene::SlabOpacity::Additive, scene::SlabOpacity::Exponential}) {
    for (const double width : {0.5, 1.0, 2.0}) {
      auto description = view_of("shells:32", 128);
      description.slab_opacity = opacity;
      description.slab_width = width;
      const Lsb8 apart = measure(description, "base");
      EXPECT_LE(apart.largest, 3.0);
      EXPECT_GE(apart.psnr_db, 48.0);
    }
  }
  auto description = view_of("shells:32", 128);
  description.camera.projection = scene::Projection::Perspective;
  const Lsb8 apart = measure(description, "base");
  EXPECT_LE(apart.largest, 3.0);
  EXPECT_GE(apart.psnr_db, 48.0);
}

// The gain of `fine` for colours: its centres are four times as fine and its weights have no steps. In pictures this
// small that is the lesser part (products and sums have 16 bits in both), but it decides the worst pixel.
TEST(Budget, fine_errs_less_than_base_from_far_and_near) {
  for (const double zoom : {1.0, 3.0, 8.0}) {
    auto description = view_of("shells:32", 128);
    description.camera.zoom = zoom;
    const Lsb8 base = measure(description, "base"), fine = measure(description, "fine");
    figure("fine above base, PSNR, zoom " + std::to_string(static_cast<int>(zoom)), fine.psnr_db - base.psnr_db, "dB");
    EXPECT_LT(fine.rms, base.rms) << "zoom " << zoom;
    EXPECT_LT(fine.largest, 0.75 * base.largest) << "zoom " << zoom;
  }
}

TEST(Budget, every_configuration_errs_more_with_fewer_bits) {
  // splatting.md 5: snapping costs 0.27/(s k) rms of a sheet, so k = 8 against k = 64 must show, and 8-bit weights too.
  const auto description = view_of("shells:32", 128);
  const double base = measure(description, "base").rms;
  const double small = measure(description, "small").rms;
  const double compact = measure(description, "compact").rms;
  const double year2000 = measure(description, "year2000").rms;
  EXPECT_LT(base, small);
  EXPECT_LT(small, compact);
  EXPECT_LT(compact, year2000);
  EXPECT_NEAR(measure(description, "wide").rms, base, 1e-12) << "lanes alone must not change a bit";
}

}  // namespace
}  // namespace fastsplat::driver
