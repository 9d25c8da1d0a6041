// SPDX-License-Identifier: Apache-2.0
// Pictures without counters: the same words, and less work. (More scenes and configurations, fast_unit_slow_test.cpp.)
#include "driver/tiles/picture.hpp"

#include <gtest/gtest.h>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "scene/splat_store.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

struct TwoPictures {
  DeviceRender picture, counted;
};

/// Without and with counters; by default the picture in bands of a row of blocks.
TwoPictures drawn_twice(const scene::SceneDescription& description, const cmodel::Config& config, int band_rows = 1) {
  const scene::Scene scene = scene::build_scene(description);
  TwoPictures out{.picture = render(scene, config, {.threads = 2, .counters = false, .band_rows = band_rows}),
                  .counted = render(scene, config, {.threads = 1, .band_rows = band_rows})};
  EXPECT_EQ(out.picture.frame.words, out.counted.frame.words);
  EXPECT_TRUE(out.counted.counted);
  return out;
}

// An opaque shell: what lies behind it is not visited.
TEST(Picture, VisitsOnlyWhatCanChangeAPixel) {
  for (const char* volume : {"shells:48", "binary-cube:40"}) {
    for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned}) {
      for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
        auto description = view_of(volume, 72);
        description.opacity_scale = 6.0;
        description.method = method;
        description.camera.projection = projection;
        const TwoPictures both = drawn_twice(description, load_config("base"));
        EXPECT_FALSE(both.picture.counted);
        figure("voxels visited, of all", static_cast<double>(both.picture.report.voxels) /
                                              static_cast<double>(both.counted.report.voxels));
        figure("records drawn, of all", static_cast<double>(both.picture.report.splat_records) /
                                             static_cast<double>(both.counted.report.splat_records));
        EXPECT_LT(both.picture.report.voxels, both.counted.report.voxels);
        EXPECT_LT(both.picture.report.splat_records, both.counted.report.splat_records);
      }
    }
  }
}

// In one band, where both count alike: a record on terminated blocks alone is not drawn.
TEST(Picture, DrawsNoRecordThatTheCountingUnitHides) {
  auto description = view_of("binary-cube:40", 72);
  description.opacity_scale = 6.0;
  const TwoPictures both = drawn_twice(description, load_config("base"), 1000);
  EXPECT_FALSE(both.picture.counted);
  figure("records drawn", static_cast<double>(both.picture.report.splat_records));
  figure("records of the counting unit, hidden", static_cast<double>(both.counted.units.hidden_splats));
  EXPECT_GT(both.counted.units.hidden_splats, 0U);
  EXPECT_LE(both.picture.report.splat_records,
            both.counted.report.splat_records - both.counted.units.hidden_splats);
}

// Where nothing is hidden, everything is visited once, whatever bands there are.
TEST(Picture, CountsASplatInOneBand) {
  auto description = view_of("shells:24", 60);
  description.opacity_scale = 2e-5;
  const TwoPictures both = drawn_twice(description, load_config("exact"));  // a tile: records of several would be more
  EXPECT_FALSE(both.picture.counted);
  figure("voxels", static_cast<double>(both.picture.report.voxels));
  EXPECT_EQ(both.picture.report.voxels, both.counted.report.voxels);
  EXPECT_EQ(both.picture.report.splat_records, both.counted.report.splat_records);
  figure("voxels that vanished", static_cast<double>(both.picture.report.vanished_voxels));
  EXPECT_GT(both.picture.report.vanished_voxels, 0U);
  EXPECT_EQ(both.picture.report.vanished_voxels, both.counted.report.vanished_voxels);
  EXPECT_NEAR(both.picture.report.vanished_share, both.counted.report.vanished_share, 1e-12);  // sums of 64 bits
}

// Frames that share a store: views, methods and devices change, and the store may be too small.
TEST(Picture, IsTheSameFromAStore) {
  std::size_t frames = 0, different = 0;
  for (const std::size_t room : {std::size_t{200'000}, std::size_t{1} << 30}) {
    const auto store = std::make_shared<scene::SplatStore>(room);
    for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned}) {
      for (const char* name : {"base", "compact"}) {
        for (const double azimuth : {10.0, 100.0, 235.0}) {
          for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
            auto description = view_of("shells:40", 72);
            description.method = method;
            description.camera.azimuth = azimuth;
            description.camera.projection = projection;
            scene::Scene scene = scene::build_scene(description);
            const auto alone = render(scene, load_config(name), {.threads = 1, .counters = false, .band_rows = 8});
            scene.store = store;
            const auto shared = render(scene, load_config(name), {.threads = 2, .counters = false, .band_rows = 8});
            EXPECT_FALSE(shared.counted);
            ++frames;
            different += alone.frame.words == shared.frame.words &&
                                 alone.report.splat_records == shared.report.splat_records &&
                                 alone.report.voxels == shared.report.voxels
                             ? 0
                             : 1;
          }
        }
      }
    }
    figure("bytes kept", static_cast<double>(store->bytes()));
    EXPECT_GT(store->bytes(), 0U);
  }
  figure("frames", static_cast<double>(frames));
  figure("frames that differ", static_cast<double>(different));
  EXPECT_EQ(different, 0U);
}

// Losses of visible pixels are reported as they are with counters.
TEST(Picture, HasTheLossesOfVisiblePixels) {
  auto description = view_of("shells:24", 60);
  description.opacity_scale = 80.0;
  cmodel::Config config = load_config("base");
  config.pixel_int_bits = 0, config.freeze_below = 1;  // 1.0 is reached and saturates
  const TwoPictures both = drawn_twice(description, config);
  EXPECT_FALSE(both.picture.counted);
  figure("saturated records", static_cast<double>(both.picture.report.saturated_records));
  figure("output words saturated", static_cast<double>(both.picture.counters.pixel_saturated));
  EXPECT_GT(both.picture.report.saturated_records, 0U);
  EXPECT_LT(both.picture.report.saturated_records, both.counted.report.saturated_records);
  EXPECT_GT(both.picture.counters.pixel_saturated, 0U);
  EXPECT_EQ(both.picture.counters.pixel_saturated, both.counted.counters.pixel_saturated);
}

// Frames that cannot be drawn so are counted: sums that are cut, error diffusion, ellipses, densities, every sample.
TEST(Picture, LeavesOtherFramesToTheCountingUnits) {
  const auto counted = [](void (*change)(scene::SceneDescription&, cmodel::Config&)) {
    auto description = view_of("shells:16", 48);
    cmodel::Config config = load_config("base");
    change(description, config);
    return drawn_twice(description, config).picture.counted;
  };
  EXPECT_TRUE(counted([](auto& d, auto&) { d.method = scene::Method::XRay; }));
  EXPECT_FALSE(counted([](auto& d, auto& c) {
    d.method = scene::Method::XRay;
    c.rounding_carry = static_cast<int>(cmodel::Carry::Off);
  }));
  EXPECT_TRUE(counted([](auto& d, auto&) { d.slab_width = 4.0, d.opacity_scale = 30.0; }));
  EXPECT_TRUE(counted([](auto& d, auto& c) {
    d.footprint.antialias = true;
    c = load_config("ellipse");
  }));
  EXPECT_TRUE(counted([](auto& d, auto& c) {
    d.method = scene::Method::Westover;
    c.composite_every_sample = 1;
  }));
  EXPECT_TRUE(counted([](auto& d, auto& c) {
    d.classify = scene::ClassifyOrder::Post;
    c.classify_segment_bits = 9;
  }));
}

}  // namespace
}  // namespace fastsplat::driver
