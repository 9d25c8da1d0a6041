// SPDX-License-Identifier: Apache-2.0
// The gain of culling on a real head (Debian's mricron-data): same picture, cycles, and processor time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <ctime>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/culling_comparison.hpp"
#include "driver/tiles/render.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::driver {
namespace {

constexpr std::uint64_t kLatency = 40;  ///< cycles of a memory

/// The rows of docs/culling.md's tables: cycles in millions.
void print(const std::string& name, const std::vector<CullRow>& rows) {
  const auto millions = [](std::uint64_t cycles) { return static_cast<double>(cycles) / 1e6; };
  const auto fewer = [&](const CullRow& row) {
    return static_cast<double>(rows[0].cycles) / static_cast<double>(row.cycles);
  };
  std::printf("[table] | %s | %.2f | %.1f |", name.c_str(), millions(rows[0].cycles), millions(rows[0].cycles) * 10.0);
  for (const std::size_t i : {1U, 2U, 4U}) std::printf(" %.2f (%.2fx) |", millions(rows[i].cycles), fewer(rows[i]));
  std::printf(" %.1f | %.1f |\n", 100.0 * share_drawn(rows[1], rows[0]), 100.0 * share_drawn(rows[3], rows[0]));
  const CullRow& row = rows[2];
  const auto& a = row.account;
  std::printf("[where] | %s | %.2f | %.2f | %.2f | %.3f | %.3f | %.3f | %.3f |\n", name.c_str(), millions(row.cycles),
              millions(row.counters.windows), millions(a.hidden), millions(a.records),
              millions(a.input + a.sheet_buffer + a.drain), millions(a.map), millions(a.pixels + a.output));
  figure(name + ": block, fetch: times fewer", fewer(row));
}

TEST(CulledHead, IsTheSamePictureInFewerCycles) {
  std::string why_not;
  const auto volume = head_scan(why_not);
  if (!volume) GTEST_SKIP() << "the scan is not installed: " << why_not;
  for (const int size : {256, 512}) {
    const auto scene = scene::build_scene(view_of("ch2bet", size, "mri-head"), volume);
    const auto rows = compare_culling(scene, load_config("base"), kLatency, 0);
    print("head, " + std::to_string(size), rows);
    EXPECT_GT(static_cast<double>(rows[0].cycles), (size == 512 ? 2.5 : 2.4) * static_cast<double>(rows[2].cycles));
  }
}

struct Goal {
  const char* name;
  const char* volume;
  const char* transfer_function;
  int size;
  double opacity_scale, zoom;
  double times_fewer;  ///< with blocks and a source that jumps, at least
  double cost;         ///< at most, where every beat is sent
};
/// From scenes that hide much to scenes that hide nothing (docs/culling.md). Thin fibres hide little: the gaps between
/// them stay open.
const Goal kGoals[] = {
    {"solid", "binary-cube:256", "binary", 512, 20.0, 1.0, 4.0, 0.01},
    {"256^3 opaque", "shells:256", "default", 512, 20.0, 1.0, 2.5, 0.01},
    {"opaque", "shells:128", "default", 512, 20.0, 1.0, 2.2, 0.01},
    {"fibres", "fire:128", "fire", 512, 1.0, 1.0, 0.99, 0.01},
    {"transparent", "shells:128", "default", 512, 0.05, 1.0, 0.99, 0.01},
    // The deck's shares of visible voxels, and its gain at each (54.6 s to 12.7 s at 3 %). A wall of 128 sheets fills
    // the picture. All of its groups are as small as groups can be, so its records cost a hundredth.
    {"wall, 3 %", "binary-cube:256", "binary", 128, 20.0, 6.0, 54.6 / 12.7, 0.02},
    {"wall, 10 %", "binary-cube:256", "binary", 128, 0.69, 6.0, 17.6 / 8.4, 0.02},
    {"wall, 21 %", "binary-cube:256", "binary", 128, 0.28, 6.0, 35.8 / 14.8, 0.02},
    {"wall, 37 %", "binary-cube:256", "binary", 128, 0.15, 6.0, 36.8 / 15.5, 0.02},
};

class CulledScenes : public ::testing::TestWithParam<Goal> {};

TEST_P(CulledScenes, TakeFewerCyclesOrHardlyMore) {
  const Goal& goal = GetParam();
  auto description = view_of(goal.volume, goal.size, goal.transfer_function);
  description.opacity_scale = goal.opacity_scale;
  description.camera.zoom = goal.zoom;
  const auto rows = compare_culling(scene::build_scene(description), load_config("base"), kLatency, 0);
  print(goal.name, rows);
  ASSERT_EQ(rows.size(), 5U);
  const auto off = static_cast<double>(rows[0].cycles);
  for (const CullRow& row : rows) {
    EXPECT_LE(static_cast<double>(row.cycles), off * (1.0 + goal.cost)) << row.map;
    if (row.fetch) {
      EXPECT_GE(off, goal.times_fewer * static_cast<double>(row.cycles)) << row.map;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Goals, CulledScenes, ::testing::ValuesIn(kGoals), [](const auto& of) {
  std::string name = of.param.name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
});

/// The figures of docs/culling.md, "Limits". Sets hold circles only, so a source can leave nothing out.
TEST(CulledEllipses, TakeFewerCyclesWhereTheyHaveSeveralWindows) {
  auto description = view_of("shells:128", 512, "default");
  description.opacity_scale = 20.0;
  description.camera.projection = scene::Projection::Perspective;
  description.footprint.shape = scene::FootprintShape::Ellipse;
  const auto rows = compare_culling(scene::build_scene(description), load_config("ellipse"), kLatency, 0);
  ASSERT_EQ(rows.size(), 5U);
  char told[80];
  std::snprintf(told, sizeof told, "takes %.2f million cycles\n  instead of %.2f.\n",
                static_cast<double>(rows[1].cycles) / 1e6, static_cast<double>(rows[0].cycles) / 1e6);
  std::printf("[figure] ellipses: %s", told);
  EXPECT_LT(rows[1].cycles, rows[0].cycles);
  EXPECT_NE(read_text_file(FASTSPLAT_SOURCE_DIR "/docs/culling.md").find(told), std::string::npos);
}

/// Of this thread only.
double processor_seconds() {
  timespec at{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

TEST(CulledHead, TakesLessOfTheProcessor) {
  std::string why_not;
  const auto volume = head_scan(why_not);
  if (!volume) GTEST_SKIP() << "the scan is not installed: " << why_not;
  const auto scene = scene::build_scene(view_of("ch2bet", 512, "mri-head"), volume);
  cmodel::Config off = load_config("base"), block = off;
  block.cull_map = static_cast<int>(cmodel::CullMap::Block);
  for (const Unit unit : {Unit::Fast, Unit::Plain}) {
    double without = 1e9, with = 1e9;  // the best of some rounds, alternating
    for (int round = 0; round < (unit == Unit::Fast ? 5 : 2); ++round) {
      const double a = processor_seconds();
      const DeviceRender unculled = render(scene, off, {.threads = 1, .unit = unit});
      const double b = processor_seconds();
      const DeviceRender culled = render(scene, block, {.threads = 1, .unit = unit});
      const double c = processor_seconds();
      without = std::min(without, b - a), with = std::min(with, c - b);
      EXPECT_EQ(unculled.frame.words, culled.frame.words);
      EXPECT_EQ(unculled.units.fast > 0, culled.units.fast > 0);
    }
    const std::string name = unit == Unit::Fast ? "ch2bet 512, fast unit" : "ch2bet 512, plain unit";
    figure(name + ": without", without, "s");
    figure(name + ": with", with, "s");
    figure(name + ": times faster", without / with);
    if (unit == Unit::Plain) {
      EXPECT_LT(with, without);
    }
  }
}

}  // namespace
}  // namespace fastsplat::driver
