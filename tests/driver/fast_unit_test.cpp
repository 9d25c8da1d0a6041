// SPDX-License-Identifier: Apache-2.0
// Counts of the fast unit for records that it does not draw: hidden splats, splats of hidden cells, and ellipses that
// reach over several bands. The plain unit makes every one of them. (Words and more scenes: fast_unit_slow_test.cpp.)
#include <gtest/gtest.h>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

struct Both {
  DeviceRender fast, plain;
};

/// The frames of both units, each drawn by the named unit; the fast one in bands of one row of blocks.
Both drawn(const scene::SceneDescription& description, const cmodel::Config& config) {
  EXPECT_FALSE(cmodel::first_violation(config));
  const scene::Scene scene = scene::build_scene(description);
  Both out{.fast = render(scene, config, {.threads = 1, .band_rows = config.lanes}),
           .plain = render(scene, config, {.threads = 1, .unit = Unit::Plain})};
  EXPECT_EQ(out.fast.units.why_plain, nullptr);
  EXPECT_EQ(out.fast.units.fast, out.fast.report.tiles);
  EXPECT_EQ(out.fast.units.plain, 0U);
  EXPECT_EQ(out.plain.units.plain, out.plain.report.tiles);
  EXPECT_EQ(out.plain.units.fast, 0U);
  EXPECT_EQ(out.fast.frame.words, out.plain.frame.words);
  EXPECT_EQ(out.fast.counters, out.plain.counters);
  EXPECT_EQ(out.fast.report.splat_records, out.plain.report.splat_records);
  EXPECT_EQ(out.fast.report.saturated_records, out.plain.report.saturated_records);
  return out;
}

// Opaque enough that shares leave U 0.cf and blocks freeze, but no sum leaves the sheet.
TEST(FastUnitCounts, HiddenRecordsThatAreSaturated) {
  auto description = view_of("shells:24", 60);
  description.opacity_scale = 80.0;
  const Both both = drawn(description, load_config("base"));
  figure("records hidden", static_cast<double>(both.fast.units.hidden_splats));
  figure("records saturated", static_cast<double>(both.fast.report.saturated_records));
  EXPECT_GT(both.fast.units.hidden_splats, 1000U);
  EXPECT_GT(both.fast.report.saturated_records, 1000U);
}

// The same on a culling device: many small footprints form groups, and behind them few do not. Sheets have room for all
// overlapping splats.
TEST(FastUnitCounts, SaturatedRecordsOfADeviceThatCulls) {
  auto description = view_of("shells:48", 64);
  description.opacity_scale = 100.0;
  auto config = load_config("base");
  config.cull_map = static_cast<int>(cmodel::CullMap::Block);
  config.sheet_int_bits = 4;
  const Both both = drawn(description, config);
  // Fewer than on the device without culling: records of hidden groups are not made.
  config.cull_map = static_cast<int>(cmodel::CullMap::Off);
  const DeviceRender off = render(scene::build_scene(description), config, {.threads = 1});
  figure("records, none left out", static_cast<double>(off.report.splat_records));
  figure("records", static_cast<double>(both.fast.report.splat_records));
  figure("records saturated", static_cast<double>(both.fast.report.saturated_records));
  figure("records hidden one by one", static_cast<double>(both.fast.units.hidden_splats));
  EXPECT_EQ(both.fast.units.hidden_splats, both.plain.units.hidden_splats);
  EXPECT_EQ(both.fast.frame.words, off.frame.words);
  EXPECT_LT(both.fast.report.splat_records, off.report.splat_records);
  EXPECT_GT(both.fast.report.saturated_records, 10000U);
  EXPECT_GT(both.fast.units.hidden_splats, 1000U);
}

// Ellipses of several records, one above the other: a band counts the records that begin in it, whatever other records
// the splat has.
TEST(FastUnitCounts, EveryRecordOfAnEllipseInOneBand) {
  auto description = view_of("shells:12", 96);
  description.camera.projection = scene::Projection::Perspective;
  description.footprint.shape = scene::FootprintShape::Ellipse;
  const Both both = drawn(description, load_config("ellipse"));
  const double records = static_cast<double>(both.fast.counters.splats);
  figure("records", records);
  figure("windows of a record", static_cast<double>(both.fast.counters.windows) / records);
  EXPECT_EQ(both.fast.counters.splats, both.fast.report.splat_records);
  EXPECT_GT(both.fast.counters.splats, 2000U);
}

}  // namespace
}  // namespace fastsplat::driver
