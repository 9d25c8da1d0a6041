// SPDX-License-Identifier: Apache-2.0
// Culling (docs/numerics.md, section 6.1): model against an oracle that tests every pixel, culled against unculled, the
// rules of cull_block, and that no visible splat is hidden.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "base/error.hpp"
#include "cmodel/model.hpp"
#include "cmodel/rtl_package/sv_package.hpp"
#include "cmodel/stream/stream_rules.hpp"
#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::CullMap;

cmodel::Config culling(cmodel::Config config, CullMap map) {
  config.cull_map = static_cast<int>(map);
  return config;
}

class Culling : public ::testing::TestWithParam<std::tuple<std::string, CullMap>> {};

// The remaining splats are drawn in their order, as if the others did not exist (N-6.1-12).
TEST_P(Culling, ModelEqualsOracle) {
  const auto& [name, map] = GetParam();
  const cmodel::Config config = culling(named_config(name), map);
  ASSERT_FALSE(cmodel::first_violation(config));
  Random random(seed_or(91));
  const Campaign result = compare_streams(config, random, 4000, 300);
  print(("culling, " + name).c_str(), result.comparison);
  EXPECT_EQ(result.comparison.mismatches, 0U) << result.comparison.first;
  for (const char* what : {"snap", "footprint", "sheet", "composite", "pixel", "picture", "counter"})
    EXPECT_GT(result.comparison.compared.count(what), 0U) << what << ": nothing was compared";
}

INSTANTIATE_TEST_SUITE_P(Configs, Culling,
                         ::testing::Combine(::testing::Values("tiny", "base", "ellipse"),
                                            ::testing::Values(CullMap::Block, CullMap::Pixel)),
                         [](const auto& param_info) {
                           return std::get<0>(param_info.param) +
                                  (std::get<1>(param_info.param) == CullMap::Block ? "_block" : "_pixel");
                         });

TEST(CullingRandom, ModelEqualsOracleOnRandomConfigurations) {
  Random random(seed_or(92));
  Comparison all;
  for (int i = 0; i < 40; ++i) {
    const cmodel::Config drawn = i % 2 == 0 ? random_config(random) : random_ellipse_config(random);
    const cmodel::Config config = culling(drawn, i % 4 < 2 ? CullMap::Block : CullMap::Pixel);
    all += compare_streams(config, random, 150, 150).comparison;
    ASSERT_EQ(all.mismatches, 0U) << "configuration " << i << ": " << all.first;
  }
  print("culling, random configurations", all);
}

struct Ran {
  Collector seen;
  cmodel::Counters counters;
  cmodel::CullCounts culls;
  cmodel::CullLog log;
};

/// The hash in begin_frame becomes this configuration's.
void run(const cmodel::Config& config, std::vector<std::uint8_t> bytes, Ran& out,
         cmodel::StreamScope scope = cmodel::StreamScope::Whole) {
  const std::uint64_t hash = cmodel::config_hash(config);
  for (std::size_t i = 0; i < 8; ++i) bytes[8 + i] = static_cast<std::uint8_t>(hash >> (8 * i));
  seal(bytes);
  cmodel::Model model(config, scope, out.seen);
  model.log_culls(&out.log);
  const auto beats = to_beats(bytes);
  model.consume(beats);
  model.finish();
  out.counters = model.counters();
  out.culls = model.culls();
}

// N-6.1-1
TEST(CullingRandom, NoWordOfThePictureDependsOnTheMap) {
  Random random(seed_or(93));
  cmodel::CullCounts culls;
  std::uint64_t tiles = 0, splats = 0, windows_less = 0;
  for (int i = 0; i < 60; ++i) {
    cmodel::Config config = i % 3 == 0   ? named_config("tiny")
                            : i % 3 == 1 ? random_config(random)
                                         : random_ellipse_config(random);
    config = culling(config, CullMap::Block);
    const auto stream = random_stream(symbols_of(config), random, 300);
    Ran off, block, pixel;
    run(culling(config, CullMap::Off), stream.bytes, off);
    run(config, stream.bytes, block);
    run(culling(config, CullMap::Pixel), stream.bytes, pixel);
    ASSERT_EQ(off.seen.rendering.tiles, block.seen.rendering.tiles) << "configuration " << i;
    ASSERT_EQ(off.seen.rendering.tiles, pixel.seen.rendering.tiles) << "configuration " << i;
    EXPECT_EQ(off.log.size(), 0U);
    for (const Ran* one : {&block, &pixel}) {
      // The counters of numerics.md (N-6.1-11, N-9-16).
      EXPECT_EQ(one->counters.tiles, off.counters.tiles);
      EXPECT_EQ(one->counters.sheets, off.counters.sheets);
      EXPECT_EQ(one->counters.cull_blocks, off.counters.cull_blocks);
      EXPECT_EQ(one->counters.splats + one->culls.dropped, off.counters.splats);
      EXPECT_EQ(one->counters.composite_saturated, off.counters.composite_saturated);
      EXPECT_EQ(one->counters.pixel_saturated, off.counters.pixel_saturated);
      EXPECT_LE(one->counters.windows, off.counters.windows);
      EXPECT_LE(one->counters.dirty_blocks, off.counters.dirty_blocks);
      culls += one->culls;
      windows_less += off.counters.windows - one->counters.windows;
    }
    // Cells of `block` are coarser: they hide less.
    EXPECT_GE(pixel.culls.hidden_splats + pixel.culls.dropped, block.culls.hidden_splats + block.culls.dropped);
    tiles += off.counters.tiles;
    splats += 2 * off.counters.splats;
  }
  std::printf(
      "[figure] tiles = %llu, splats = %llu, sets tested = %llu, hidden = %llu, splats tested = %llu, hidden = %llu, "
      "dropped = %llu, windows hidden = %llu, windows less = %llu\n",
      static_cast<unsigned long long>(tiles), static_cast<unsigned long long>(splats),
      static_cast<unsigned long long>(culls.set_tests), static_cast<unsigned long long>(culls.hidden_sets),
      static_cast<unsigned long long>(culls.splat_tests), static_cast<unsigned long long>(culls.hidden_splats),
      static_cast<unsigned long long>(culls.dropped), static_cast<unsigned long long>(culls.hidden_windows),
      static_cast<unsigned long long>(windows_less));
  EXPECT_GT(culls.hidden_sets, 100U);
  EXPECT_LT(culls.hidden_sets, culls.set_tests);
  EXPECT_GT(culls.hidden_splats, 1000U);
  EXPECT_LT(culls.hidden_splats, culls.splat_tests);
  EXPECT_GT(culls.dropped, 100U);
  EXPECT_GT(culls.hidden_windows, 100U);
}

/// A tile of several sheets, each a wall: a splat on every block.
std::vector<std::uint8_t> walls(const cmodel::Config& config, int mode, int sheets) {
  const oracle::Symbols symbols = symbols_of(config);
  StreamWriter w(symbols);
  w.begin_frame(config.tile_width, config.tile_height, 1);
  const std::uint32_t most = (1U << (config.radial_int_bits + config.radial_frac_bits)) - 1;
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), most));
  w.load_table(2, 0, 0, 0,
               std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1,
                                          1U << config.opacity_frac_bits));
  const int lanes = config.lanes;
  const auto rho = static_cast<std::uint32_t>(lanes * config.phases / 2);
  w.load_table(0, 0, rho, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(lanes) * config.phases, 0));
  w.begin_tile(mode, 0, 0, 0, config.tile_width, config.tile_height);
  const auto full = static_cast<std::uint32_t>(config.colour_format().max);
  for (int s = 0; s < sheets; ++s) {
    w.begin_sheet(static_cast<std::uint32_t>(s));
    for (int y = 0; y < config.tile_height; y += lanes)
      for (int x = 0; x < config.tile_width; x += lanes)
        w.splat(0, (x + lanes / 2 - 1) << config.position_frac_bits, (y + lanes / 2 - 1) << config.position_frac_bits,
                {full, full, full, full});
    w.end_sheet();
  }
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

// N-6.1-4; a hidden splat counts as one and has no window (N-6.1-9); in other modes there are no tests (N-6.1-2).
// M-cull-2.
TEST(CullingRule, SheetsAreTestedAgainstTheLastButOne) {
  for (const CullMap map : {CullMap::Block, CullMap::Pixel}) {
    cmodel::Config config = culling(named_config("tiny"), map);
    config.composite_every_sample = 1;
    config.freeze_below = 1 << config.composite_frac_bits;  // every drawn pixel is frozen
    const auto cells =
        static_cast<std::uint64_t>(config.tile_width / config.lanes * (config.tile_height / config.lanes));
    for (const int mode : {0, 1, 2, 4, 5}) {
      for (int sheets = 1; sheets <= 5; ++sheets) {
        Ran out;
        run(config, walls(config, mode, sheets), out);
        // All of a sheet's splats, from the third sheet on.
        const std::uint64_t hidden = mode < 2 && sheets > 2 ? cells * static_cast<std::uint64_t>(sheets - 2) : 0;
        EXPECT_EQ(out.culls.hidden_splats, hidden) << "mode " << mode << ", sheets " << sheets;
        EXPECT_EQ(out.counters.splats, cells * static_cast<std::uint64_t>(sheets));
        EXPECT_EQ(out.counters.windows + hidden, cells * static_cast<std::uint64_t>(sheets));
        if (mode >= 2) {
          EXPECT_EQ(out.log.size(), 0U) << "no test is made in mode " << mode;
        }
      }
    }
  }
}

// N-6.1-5, N-6.1-6 and N-6.1-7: the page's number of bits decides every rectangle exactly.
TEST(CullingRule, WordsOfTheTableAreModular) {
  Random random(seed_or(94));
  std::uint64_t tests = 0, hidden = 0;
  for (const int cell : {1, 4, 8}) {
    cmodel::CullTable table(40, 24, cell);
    const int width = 37, height = 24;
    table.begin_tile(width, height);
    std::vector<std::uint8_t> map(static_cast<std::size_t>(table.columns()) * static_cast<std::size_t>(table.rows()));
    const auto opaque = [&](int x, int y) { return map[static_cast<std::size_t>(y * table.columns() + x)] != 0; };
    for (int round = 0; round < 40; ++round) {
      int first = table.rows();
      for (int i = 0; i < static_cast<int>(map.size()) / 10 + 1; ++i) {
        const auto at = static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(map.size()) - 1));
        if (random.once_in(40)) continue;
        map[at] = 1;
        first = std::min(first, static_cast<int>(at) / table.columns());
      }
      table.build(first, opaque);
      for (int i = 0; i < 300; ++i) {
        const auto x = random.between(-9, width + 3), y = random.between(-9, height + 3);
        const cmodel::PixelBox box{x, y, x + random.between(0, 20), y + random.between(0, 12)};
        bool all = true;
        for (std::int64_t py = std::max<std::int64_t>(box.y0, 0); py < std::min<std::int64_t>(box.y1, height); ++py)
          for (std::int64_t px = std::max<std::int64_t>(box.x0, 0); px < std::min<std::int64_t>(box.x1, width); ++px)
            all = all && opaque(static_cast<int>(px) / cell, static_cast<int>(py) / cell);
        ASSERT_EQ(table.hidden(box), all);
        ++tests;
        hidden += all ? 1 : 0;
      }
    }
    EXPECT_EQ(table.largest_word(), cell == 1 ? 1023U : cell == 4 ? 63U : 15U);
  }
  std::printf("[figure] rectangles tested = %llu, hidden = %llu\n", static_cast<unsigned long long>(tests),
              static_cast<unsigned long long>(hidden));
  EXPECT_GT(hidden, tests / 10);
  EXPECT_LT(hidden, tests * 9 / 10);
}

// M-cull-1
TEST(CullingRule, TheRtlHasCullingWithEllipses) {
  for (const CullMap map : {CullMap::Off, CullMap::Block, CullMap::Pixel}) {
    EXPECT_FALSE(cmodel::rtl_violation(culling(named_config("tiny"), map)));
    EXPECT_FALSE(cmodel::rtl_violation(culling(named_config("ellipse"), map)));
  }
}

/// A sheet of three splats in a row, with the records before each of them.
using Writing = std::function<void(StreamWriter&, int splat)>;
std::string refusal(const cmodel::Config& config, const Writing& before,
                    cmodel::StreamScope scope = cmodel::StreamScope::Whole) {
  StreamWriter w(symbols_of(config));
  w.begin_frame(config.tile_width, config.tile_height, 1);
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), 1));
  w.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1, 1));
  const int lanes = config.lanes;
  w.load_table(0, 0, static_cast<std::uint32_t>(lanes * config.phases / 2), 0,
               std::vector<std::uint32_t>(static_cast<std::size_t>(lanes) * config.phases, 0));
  w.begin_tile(0, 0, 0, 0, config.tile_width, config.tile_height);
  w.begin_sheet(0);
  for (int i = 0; i < 3; ++i) {
    before(w, i);
    // Windows from pixel (4 i + 1 - P/2, 5 - P/2) on.
    w.splat(0, (4 * i) << config.position_frac_bits, 4 << config.position_frac_bits, {1, 1, 1, 1});
  }
  before(w, 3);
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  Ran out;
  try {
    run(config, w.bytes(), out, scope);
  } catch (const cmodel::StreamRefusal& refused) {
    EXPECT_EQ(refused.rule(), cmodel::StreamRule::Promise);
    return refused.what();
  }
  return "";
}

/// A cull_block before splat `at`.
Writing announced(int at, std::uint32_t tag, int x, int y, int width, int height, std::uint32_t splats) {
  return [=](StreamWriter& w, int splat) {
    if (splat == at) w.cull_block(tag, x, y, width, height, splats);
  };
}
/// One cull_block more than a tile has cells, each of one splat.
Writing too_many_sets(const cmodel::Config& config) {
  return [sets = cmodel::cull_sets(config)](StreamWriter& w, int splat) {
    for (std::uint32_t i = 0; splat == 0 && i <= sets; ++i) w.cull_block(i, 0, 0, 30, 30, 1);
  };
}
/// Tags are compared modulo 2^32: with more announced splats, splats outside the rectangle would pass for later ones.
constexpr std::uint32_t kMostToCome = 1U << 31;
/// Two cull_blocks, each with as many splats as may be announced.
void twice_the_most(StreamWriter& w, int splat) {
  for (std::uint32_t i = 0; splat == 0 && i < 2; ++i) w.cull_block(i * kMostToCome, 0, 0, 30, 30, kMostToCome);
}

// S-cull-4 to S-cull-8, and cases that keep each.
TEST(CullingRule, AnnouncementsAreChecked) {
  const cmodel::Config config = culling(named_config("tiny"), CullMap::Block);
  const int lanes = config.lanes, first = 1 - lanes / 2;
  const int y = 5 - lanes / 2;
  EXPECT_EQ(refusal(config, [](StreamWriter&, int) {}), "");
  // Of the first splat's windows, the part left of the tile need not be in the rectangle (S-cull-7).
  EXPECT_EQ(refusal(config, announced(0, 0, 0, y, 8 + first + lanes, lanes, 3)), "");
  EXPECT_EQ(refusal(config, announced(1, 1, 4 + first, y, 4 + lanes, lanes, 2)), "");
  EXPECT_EQ(refusal(config, announced(3, 3, 0, 0, 1, 1, 0)), "");
  std::set<std::string> texts;
  const auto refused = [&](const Writing& writing, const std::string& words) {
    const std::string text = refusal(config, writing);
    EXPECT_NE(text.find(words), std::string::npos) << text;
    std::printf("[figure] %s\n", text.c_str());
    texts.insert(text);
  };
  refused(announced(0, 0, 0, y, 7 + first + lanes, lanes, 3), "outside the rectangle of cull_block 0");
  refused(announced(1, 1, 5 + first, y, 9 + lanes, lanes, 2), "outside the rectangle");
  refused(announced(0, 0, 0, y + 1, 30, lanes, 1), "outside the rectangle");
  refused(announced(0, 0, 0, y, 30, lanes - 1, 1), "outside the rectangle");
  // S-cull-4, S-cull-8, S-cull-6.
  refused(announced(0, 1, 0, 0, 30, 30, 3), "tag");
  refused(announced(1, 1, 0, 0, 30, 30, 3), "end_sheet before all splats of cull_block");
  refused(too_many_sets(config), "too many open cull_blocks");
  // S-cull-5.
  refused(announced(0, 0, 0, 0, 1, 1, kMostToCome), "outside the rectangle");
  refused(announced(0, 0, 0, 0, 1, 1, kMostToCome + 1), "too many open splats");
  refused(announced(0, 0, 0, 0, 1, 1, 0xFFFFFFFF), "too many open splats");
  refused(twice_the_most, "too many open splats");
  EXPECT_EQ(texts.size(), 11U);
  // With culling off it is a hint (S-cull-2).
  EXPECT_EQ(refusal(culling(config, CullMap::Off), announced(0, 77, 0, 0, 1, 1, 99)), "");
}

// S-cull-11: the tag, the block's own w5 and the rectangle are checked; the number of cull_blocks and the sum of their
// w5 are not. Covered splats need not come (S-cull-10).
TEST(CullingRule, TheReaderOfASubsetChecksThreeThings) {
  const cmodel::Config config = culling(named_config("tiny"), CullMap::Block);
  int refused = 0, taken = 0;
  for (const auto& [writing, words] : {std::pair{announced(0, 1, 0, 0, 30, 30, 3), "tag"},
                                       {announced(0, 0, 0, 0, 30, 30, kMostToCome + 1), "too many open splats"},
                                       {announced(0, 0, 0, 0, 1, 1, 3), "outside the rectangle"}}) {
    const std::string text = refusal(config, writing, cmodel::StreamScope::Subset);
    EXPECT_NE(text.find(words), std::string::npos) << words << ": " << text;
    ++refused;
  }
  for (const Writing& writing : {announced(0, 0, 0, 0, 30, 30, kMostToCome), announced(1, 1, 0, 0, 30, 30, 3),
                                 too_many_sets(config), Writing{twice_the_most}}) {
    EXPECT_NE(refusal(config, writing), "") << "a whole stream may not";
    EXPECT_EQ(refusal(config, writing, cmodel::StreamScope::Subset), "");
    ++taken;
  }
  std::printf("[figure] cull_blocks of a subset: refused = %d, taken = %d\n", refused, taken);
}

}  // namespace
}  // namespace fastsplat::test
