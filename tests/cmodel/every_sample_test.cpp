// SPDX-License-Identifier: Apache-2.0
// Tiles whose samples are composited one by one (docs/numerics.md, section 6, modes 4 and 5): model against oracle, and
// the effect of their order.
#include <gtest/gtest.h>

#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

class EverySample : public ::testing::TestWithParam<std::string> {};

TEST_P(EverySample, ModelEqualsOracle) {
  const cmodel::Config config = sampling(GetParam());
  ASSERT_FALSE(cmodel::first_violation(config));
  Random random(seed_or(81));
  const Campaign result = compare_streams(config, random, 6000, 300);
  print(("every sample, " + GetParam()).c_str(), result.comparison);
  EXPECT_EQ(result.comparison.mismatches, 0U) << result.comparison.first;
  for (const char* what : {"snap", "footprint", "sheet", "composite", "pixel", "picture", "counter"})
    EXPECT_GT(result.comparison.compared.count(what), 0U) << what << ": nothing was compared";
}

INSTANTIATE_TEST_SUITE_P(Configs, EverySample, ::testing::Values("tiny", "base", "ellipse"),
                         [](const auto& param_info) { return param_info.param; });

/// A tile of two whole-window splats of one colour each, at these places.
std::vector<std::uint8_t> two(const cmodel::Config& config, int mode, bool swapped, int apart) {
  const oracle::Symbols symbols = symbols_of(config);
  StreamWriter w(symbols);
  w.begin_frame(config.tile_width, config.tile_height, 1);
  const std::uint32_t most = (1U << (config.radial_int_bits + config.radial_frac_bits)) - 1;
  w.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), most));
  w.load_table(2, 0, 0, 0,
               std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1,
                                          (1U << config.opacity_frac_bits) / 2));
  const int lanes = config.lanes;
  const auto rho = static_cast<std::uint32_t>(lanes * config.phases / 2);
  w.load_table(0, 0, rho, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(lanes) * config.phases, 0));
  w.begin_tile(mode, 0, 0, 0, config.tile_width, config.tile_height);
  w.begin_sheet(0);
  const auto part = static_cast<std::uint32_t>(config.colour_format().max) / 3;
  for (const bool second : {swapped, !swapped}) {
    const std::int32_t x = (8 + (second ? apart : 0)) << config.position_frac_bits, y = 8 << config.position_frac_bits;
    w.splat(0, x, y,
            second ? std::array<std::uint32_t, 4>{part, 0, 0, part} : std::array<std::uint32_t, 4>{0, 0, part, part});
  }
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

// N-6-14
TEST(EverySampleOrder, MattersWhereFootprintsOverlapAndNowhereElse) {
  const cmodel::Config config = sampling("tiny");
  for (const int mode : {0, 1, 4, 5}) {
    for (const int apart : {0, 1, 8}) {
      const oracle::Rendering one = run_model(config, two(config, mode, false, apart), Taps::Off),
                              other = run_model(config, two(config, mode, true, apart), Taps::Off);
      ASSERT_EQ(one.tiles.size(), 1U);
      std::size_t different = 0, lit = 0;
      for (std::size_t i = 0; i < one.tiles[0].words.size(); ++i) {
        different += one.tiles[0].words[i] != other.tiles[0].words[i] ? 1 : 0;
        lit += one.tiles[0].words[i] != 0 ? 1 : 0;
      }
      std::printf("[figure] mode %d, %d pixels apart: words lit = %zu, changed by the order = %zu\n", mode, apart, lit,
                  different);
      EXPECT_GT(lit, 0U);
      const bool overlap = apart < config.lanes;
      EXPECT_EQ(different > 0, mode >= 4 && overlap);
    }
  }
}

// N-6-11
// S-tile-1.
// N-6.2-1: this device lacks modes 8 and 9, too.
TEST(EverySampleOrder, IsRefusedByADeviceWithout) {
  int refused = 0;
  for (int mode = 3; mode < 16; ++mode) {
    for (const int every : {0, 1}) {
      cmodel::Config config = named_config("tiny");
      config.composite_every_sample = every;
      const bool known = every == 1 && (mode == 4 || mode == 5);
      try {
        run_model(config, two(config, mode, false, 0), Taps::Off);
        EXPECT_TRUE(known) << mode;
      } catch (const std::exception& error) {
        EXPECT_FALSE(known) << mode << ": " << error.what();
        EXPECT_NE(std::string(error.what()).find(every == 1 ? "0, 1, 2, 4 or 5" : "0, 1 or 2"), std::string::npos)
            << error.what();
        ++refused;
      }
    }
  }
  std::printf("[figure] modes refused = %d\n", refused);
  EXPECT_EQ(refused, 13 + 11);
}

}  // namespace
}  // namespace fastsplat::test
