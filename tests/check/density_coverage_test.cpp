// SPDX-License-Identifier: Apache-2.0
// Density tiles never hit bins of words, whatever their streams hold; colour tiles beside them do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <tuple>
#include <utility>

#include "testbench/coverage/coverage_collector.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::testbench {
namespace {

/// Bins that are sampled from taps: words, and where they lie.
constexpr const char* kGroups[] = {"factor.", "slab.",   "light.",   "picture.", "transmittance.", "block.", "pixel.",
                                   "rlut.",   "radial.", "product.", "sum.",     "bank.",          "edge.",  "phase."};

/// Hits of such bins in density tiles, or in the other tiles; and the number of these tiles.
struct Hits {
  std::uint64_t hits = 0, tiles = 0;
};
Hits of_tiles(const cmodel::Config& config, bool densities) {
  Hits all;
  for (std::uint64_t seed = 1; seed <= 72; ++seed) {
    const auto classes = stimulus_classes();
    auto document = make_stimulus(config, classes[seed % classes.size()], seed, 120).document;
    std::erase_if(document.tiles,
                  [&](const auto& tile) { return cmodel::holds_densities(tile.begin.mode) != densities; });
    if (document.tiles.empty()) continue;
    all.tiles += document.tiles.size();
    CoverageCollector collector(config, cmodel::StreamScope::Subset, {});
    collector.start(0);
    collector.consume(write_document(config, document));
    collector.finish();
    for (const auto& bin : collector.coverage().bins()) {
      const bool word = std::any_of(std::begin(kGroups), std::end(kGroups),
                                    [&](const char* group) { return bin.name.starts_with(group); });
      if (word) all.hits += bin.hits;
    }
  }
  return all;
}

TEST(DensityCoverage, TilesOfDensitiesHitNoBinOfWords) {
  const auto config = test::named_config("faults/post");
  const Hits densities = of_tiles(config, true), colours = of_tiles(config, false);
  std::printf(
      "[figure] bins of words hit by %llu tiles of densities = %llu (limit 0), by %llu of colours = %llu (limit > 0)\n",
      static_cast<unsigned long long>(densities.tiles), static_cast<unsigned long long>(densities.hits),
      static_cast<unsigned long long>(colours.tiles), static_cast<unsigned long long>(colours.hits));
  EXPECT_GT(densities.tiles, 10U);
  EXPECT_EQ(densities.hits, 0U);
  EXPECT_GT(colours.hits, 0U);
}

/// Bins of a group that a record hits, joined by commas.
std::string bins_of(const std::string& group, const cmodel::Record& record) {
  Coverage coverage;
  StreamCoverage stream(test::named_config("faults/post"), coverage);
  stream.on_record(record);
  std::string out;
  for (const auto& bin : coverage.bins())
    if (bin.hits > 0 && bin.name.starts_with(group)) out += (out.empty() ? "" : ", ") + bin.name;
  return out;
}

TEST(DensityCoverage, EachTableAndModeHasItsBin) {
  using cmodel::Mode;
  using cmodel::Table;
  for (const auto& [table, words, bins] : {std::tuple{Table::Factor, 9, "table.factor, table.last_beat_of_1"},
                                           {Table::Classify, 68, "table.classify, table.last_beat_of_4"},
                                           {Table::Root, 769, "table.root, table.last_beat_of_1"},
                                           {Table::Glint, 129, "table.glint, table.last_beat_of_1"},
                                           {Table::Lighting, 13, "table.lighting, table.last_beat_of_5"},
                                           {Table::Sheets, 6, "table.sheets"}}) {
    cmodel::LoadTable record{.table = table, .radius = {}, .words = {}};
    record.words.assign(static_cast<std::size_t>(words), 0);
    EXPECT_EQ(bins_of("table.", record), bins);
  }
  for (const auto& [mode, bin] : {std::pair{Mode::Sum, "tile.sum"},
                                  {Mode::DensityExponential, "tile.density_exponential"},
                                  {Mode::DensityAdditive, "tile.density_additive"}}) {
    cmodel::BeginTile record{};
    record.mode = mode;
    record.width = record.height = 2;
    EXPECT_EQ(bins_of("tile.", record), bin);
  }
}

}  // namespace
}  // namespace fastsplat::testbench
