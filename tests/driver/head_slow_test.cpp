// SPDX-License-Identifier: Apache-2.0
// The main use: a real head scan at 512 x 512, integer against golden (Debian's mricron-data).
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

TEST(Head, base_at_512_holds_48_db_and_3_lsb8) {
  std::string why_not;
  const auto volume = head_scan(why_not);
  if (!volume) GTEST_SKIP() << "the scan is not installed: " << why_not;
  auto description = view_of("ch2bet", 512, "mri-head");
  const auto scene = scene::build_scene(description, volume);
  const auto device = render(scene, load_config("base"));
  const Image reference = golden::render(scene);
  EXPECT_GT(*std::max_element(reference.data.begin(), reference.data.end()), 0.5f);
  const Lsb8 apart = distance(reference, to_image(device.frame));
  figure("ch2bet 512 base: voxels", static_cast<double>(device.report.voxels));
  figure("ch2bet 512 base: splat records", static_cast<double>(device.report.splat_records));
  figure("ch2bet 512 base: max", apart.largest, "LSB8");
  figure("ch2bet 512 base: rms", apart.rms, "LSB8");
  figure("ch2bet 512 base: PSNR", apart.psnr_db, "dB");
  EXPECT_LE(apart.largest, 3.0);
  EXPECT_GE(apart.psnr_db, 48.0);
  EXPECT_EQ(device.report.saturated_voxels + device.report.saturated_records, 0u);
}

// The shortest words that exist: 8 bits of colour, where every voxel of a brain is thinner than a word.
TEST(Head, an_xray_on_tiny_holds_44_db_at_every_size) {
  std::string why_not;
  const auto volume = head_scan(why_not);
  if (!volume) GTEST_SKIP() << "the scan is not installed: " << why_not;
  for (const int size : {128, 256, 512}) {
    auto description = view_of("ch2bet", size, "mri-head");
    description.method = scene::Method::XRay;
    description.camera.azimuth = 30, description.camera.elevation = 15;
    const auto scene = scene::build_scene(description, volume);
    const auto device = render(scene, load_config("tiny"));
    const Image reference = golden::render(scene);
    EXPECT_GT(*std::max_element(reference.data.begin(), reference.data.end()), 0.5f);
    const Lsb8 apart = distance(reference, to_image(device.frame));
    figure("ch2bet X-ray " + std::to_string(size) + " tiny: PSNR", apart.psnr_db, "dB");
    EXPECT_GE(apart.psnr_db, 44.0);
    EXPECT_EQ(device.report.vanished_share, 0.0);
  }
}

// Classified by pixel, 3 pixels a voxel, the whole picture covered: base's centres on 1/64 pixel and the steps of its
// radial table dominate the error.
TEST(Head, post_classified_holds_45_db_in_base_and_57_db_in_fine) {
  std::string why_not;
  const auto volume = head_scan(why_not);
  if (!volume) GTEST_SKIP() << "the scan is not installed: " << why_not;
  auto description = view_of("ch2bet", 96, "mri-head");
  description.camera.zoom = 32.0 / 3.0;
  description.classify = scene::ClassifyOrder::Post;
  const auto scene = scene::build_scene(description, volume);
  const Image reference = golden::render(scene);
  EXPECT_GT(*std::max_element(reference.data.begin(), reference.data.end()), 0.5f);
  for (const auto& [name, limit] : {std::pair{"base", 45.0}, {"fine", 57.0}}) {
    auto config = load_config(name);
    config.classify_segment_bits = 9;
    const Lsb8 apart = distance(reference, to_image(render(scene, config).frame));
    figure(std::string("ch2bet 3 pixels a voxel, post, ") + name + ": PSNR", apart.psnr_db, "dB");
    figure(std::string("ch2bet 3 pixels a voxel, post, ") + name + ": max", apart.largest, "LSB8");
    EXPECT_GE(apart.psnr_db, limit) << name;
  }
}

// Marble of 30 mm on the head, a millimetre a pixel: interpolation between nodes dominates the error.
TEST(Head, marble_holds_45_db_with_128_nodes_a_side) {
  std::string why_not;
  const auto volume = head_scan(why_not);
  if (!volume) GTEST_SKIP() << "the scan is not installed: " << why_not;
  auto description = view_of("ch2bet", 200, "mri-head");
  description.camera.zoom = 1.8;
  description.classify = scene::ClassifyOrder::Post;
  description.texture = {scene::SolidKind::Marble, scene::TextureWhere::Pixel, 30.0, 1.0};
  const auto scene = scene::build_scene(description, volume);
  const Image reference = golden::render(scene);
  EXPECT_GT(*std::max_element(reference.data.begin(), reference.data.end()), 0.5f);
  for (const auto& [bits, limit] : {std::pair{6, 35.0}, {7, 45.0}}) {
    auto config = load_config("fine");
    config.classify_segment_bits = 9;
    config.pattern_node_bits = bits;
    const Lsb8 apart = distance(reference, to_image(render(scene, config).frame));
    const std::string name = "ch2bet marble, " + std::to_string(1 << bits) + " nodes a side";
    figure(name + ": PSNR", apart.psnr_db, "dB");
    figure(name + ": max", apart.largest, "LSB8");
    EXPECT_GE(apart.psnr_db, limit) << name;
  }
}

}  // namespace
}  // namespace fastsplat::driver
