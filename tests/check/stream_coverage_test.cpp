// SPDX-License-Identifier: Apache-2.0
// Bins of streams, by hand: culling hints between circles and ellipses, sets of circles, edges and neighbours of
// densities, weights between entries. Cycle bins that a longer splat path moves.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "cmodel/cycles/cycle_stages.hpp"
#include "testbench/coverage/coverage_collector.hpp"
#include "testbench/coverage/coverage_cycles.hpp"
#include "testbench/coverage/coverage_interpolation.hpp"
#include "testbench/coverage/coverage_stream.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::testbench {
namespace {

using Records = std::vector<cmodel::Record>;

cmodel::Record sheet(std::uint32_t number) {
  cmodel::BeginSheet out{};
  out.sheet = number;
  return out;
}
cmodel::Record circle(std::uint32_t set) {
  cmodel::SplatRecord out{};
  out.set = set;
  return out;
}
const cmodel::Record kEllipse = cmodel::EllipseRecord{}, kCull = cmodel::CullBlock{}, kEnd = cmodel::EndSheet{};

/// Bins of a group that were hit, joined by commas.
std::string hit(const Coverage& coverage, const std::string& group) {
  std::string out;
  for (const auto& bin : coverage.bins())
    if (bin.hits > 0 && bin.name.starts_with(group)) out += (out.empty() ? "" : ", ") + bin.name;
  return out;
}

std::string hit(const std::string& group, const Records& records, const char* config = "faults/mustfail") {
  Coverage coverage;
  StreamCoverage stream(test::named_config(config), coverage);
  for (const auto& record : records) stream.on_record(record);
  return hit(coverage, group);
}

TEST(StreamCoverage, EllipsesAreSplatsToCullingHints) {
  EXPECT_EQ(hit("cull.", {sheet(0), kCull, kEllipse, circle(0), kEnd}), "cull.before_all_splats");
  EXPECT_EQ(hit("cull.", {sheet(0), circle(0), kCull, kEllipse, kEnd}), "cull.between_splats");
  EXPECT_EQ(hit("cull.", {sheet(0), kEllipse, kCull, kEllipse, kEnd}), "cull.between_splats");
  EXPECT_EQ(hit("cull.", {sheet(0), kEllipse, kCull, kEnd}), "cull.after_all_splats");
}

TEST(StreamCoverage, SetsAreTakenFromTheSheetsCircles) {
  const std::string other = "set.another_than_before";
  EXPECT_EQ(hit(other, {sheet(0), circle(0), kEllipse, circle(1), kEnd}), other);
  EXPECT_EQ(hit(other, {sheet(0), circle(0), circle(0), kEnd}), "");
  EXPECT_EQ(hit(other, {sheet(0), circle(1), kEnd, sheet(1), kEllipse, circle(0), kEnd}), "");
}

TEST(StreamCoverage, TilesOfDensitiesAtEdgesAndTheirSheets) {
  const auto tile = [](int x, int y, cmodel::Mode mode = cmodel::Mode::DensityAdditive) {
    cmodel::BeginTile out{};
    out.mode = mode;
    out.x = x, out.y = y, out.width = 6, out.height = 4;
    return cmodel::Record(out);
  };
  const auto of = [](const Records& records) {
    cmodel::BeginFrame frame{};
    frame.width = 20, frame.height = 10;
    Records all{frame};
    all.insert(all.end(), records.begin(), records.end());
    return hit("density.", all, "faults/post");
  };
  const auto end = [](std::uint32_t sheets) { return cmodel::Record(cmodel::EndTile{.tile = 0, .sheets = sheets}); };
  EXPECT_EQ(of({tile(0, 1)}), "density.tile_at_the_left_edge");
  EXPECT_EQ(of({tile(14, 1)}), "density.tile_at_the_right_edge");
  EXPECT_EQ(of({tile(1, 0)}), "density.tile_at_the_top_edge");
  EXPECT_EQ(of({tile(1, 6)}), "density.tile_at_the_bottom_edge");
  EXPECT_EQ(of({tile(1, 1)}), "density.tile_at_no_edge");
  EXPECT_EQ(of({tile(0, 0, cmodel::Mode::Additive), sheet(1), sheet(2), end(2)}), "");
  const std::string within = "density.tile_at_no_edge, density.sheet_";
  EXPECT_EQ(of({tile(1, 1), sheet(3), sheet(4), end(2)}), within + "behind_its_neighbour");
  EXPECT_EQ(of({tile(1, 1), sheet(3), sheet(5), end(2)}), within + "behind_a_missing_one");
  EXPECT_EQ(of({tile(1, 1), sheet(3), end(1)}), within + "alone");
}

/// In a device that interpolates and has ellipses, a window takes twelve cycles more.
TEST(ResetCoverage, TablesAndWindowsOnTheirWay) {
  const auto at = [](const char* config, const cmodel::BeatCycles& last, std::uint64_t cycle) {
    Coverage coverage;
    ResetCoverage of(test::named_config(config), coverage);
    of.on_beat(last);
    of.reset(cycle);
    return hit(coverage, "reset.");
  };
  const auto beat = [](cmodel::Opcode opcode, bool payload) {
    cmodel::BeatCycles out{};
    out.opcode = opcode;
    out.payload = payload;
    out.left = 100;
    return out;
  };
  const auto table = beat(cmodel::Opcode::LoadTable, false), words = beat(cmodel::Opcode::LoadTable, true);
  EXPECT_EQ(at("tiny", table, 101), "reset.inside_a_table");
  EXPECT_EQ(at("tiny", words, 101), "reset.inside_a_table");
  EXPECT_EQ(at("tiny", beat(cmodel::Opcode::EndTile, false), 101), "reset.between_tiles");
  const auto splat = beat(cmodel::Opcode::Splat, false);
  const std::uint64_t last = 100 + cmodel::stages::kSheet;
  const std::string windows = "reset.with_windows_in_flight";
  EXPECT_NE(at("tiny", splat, last).find(windows), std::string::npos);
  EXPECT_EQ(at("tiny", splat, last + 1).find(windows), std::string::npos);
  EXPECT_NE(at("faults/post", splat, last + 12).find(windows), std::string::npos);
  EXPECT_EQ(at("faults/post", splat, last + 13).find(windows), std::string::npos);
}

/// Streams of the device that interpolates: walks that begin at once, windows beside them, weights of both shapes.
TEST(CycleCoverage, WalksOfADeviceThatInterpolates) {
  const auto config = test::named_config("faults/post");
  Coverage all;
  for (std::uint64_t seed = 1; seed <= 18; ++seed) {
    CoverageCollector collector(config, cmodel::StreamScope::Whole, {});
    collector.start(0);
    collector.consume(write_document(config, make_stimulus(config, StimulusClass::SwapPhases, seed, 1000).document));
    collector.finish();
    all.merge(collector.coverage());
  }
  const auto hits = [&](const std::string& name) {
    for (const auto& bin : all.bins())
      if (bin.name == name) return bin.hits;
    return std::uint64_t{0};
  };
  const auto at_once = hits("swap.walk_at_once"), later = hits("swap.walk_waits_for_the_one_before");
  std::printf("[figure] walks at once = %llu, behind another = %llu (limits > 0)\n",
              static_cast<unsigned long long>(at_once), static_cast<unsigned long long>(later));
  EXPECT_GT(at_once, 0U);
  EXPECT_GT(later, 0U);
  for (const char* name : {"interpolation.circle_between_entries", "interpolation.ellipse_between_entries"}) {
    std::printf("[figure] %s = %llu (limit > 0)\n", name, static_cast<unsigned long long>(hits(name)));
    EXPECT_GT(hits(name), 0U) << name;
  }
}

/// 16 entries and the word behind them, four steps from one to the next; the fall is rounded by two bits.
TEST(InterpolationCoverage, PlacesAndRoundings) {
  const auto config = test::named_config("faults/post");
  cmodel::LoadTable table{.table = cmodel::Table::Radial, .radius = {}, .words = {}};
  for (std::uint32_t i = 0; i <= 16; ++i) table.words.push_back(100 - i);
  const auto at = [&](InterpolationCoverage::Kind kind, std::uint64_t steps) {
    Coverage coverage;
    InterpolationCoverage of(config, coverage);
    of.load(table);
    of.weight(kind, steps);
    return hit(coverage, "");
  };
  constexpr auto kCircle = InterpolationCoverage::Circle, kOval = InterpolationCoverage::Ellipse;
  EXPECT_EQ(at(kCircle, 0), "interpolation.circle_on_an_entry");
  EXPECT_EQ(at(kCircle, 60), "interpolation.circle_on_an_entry");
  EXPECT_EQ(at(kCircle, 1), "interpolation.circle_between_entries, fall.below");
  EXPECT_EQ(at(kOval, 6), "interpolation.ellipse_between_entries, fall.tie");
  EXPECT_EQ(at(kOval, 63), "interpolation.ellipse_behind_the_last_entry, fall.above");
  EXPECT_EQ(at(kCircle, 64), "");
  table.words[1] = 96;
  EXPECT_EQ(at(kCircle, 2), "interpolation.circle_between_entries, fall.exact");
}

}  // namespace
}  // namespace fastsplat::testbench
