// SPDX-License-Identifier: Apache-2.0
// Invariants of compositing, seen through the taps: transmittance never rises, alpha + transmittance is 1, frozen
// pixels stay frozen.
#include <gtest/gtest.h>

#include <map>

#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using Pixel = std::array<std::uint32_t, 4>;  // C_R, C_G, C_B, T

struct Seen {
  std::uint64_t steps = 0, frozen = 0, alphas = 0;
};

std::vector<int> tile_modes(const std::vector<std::uint8_t>& bytes) {
  std::vector<int> modes;
  for (std::size_t at = first_tile_beat(bytes) * cmodel::kBeatBytes; at < bytes.size(); at += cmodel::kBeatBytes)
    if (bytes[at] == 0x54) modes.push_back(bytes[at + 1]);
  return modes;
}

void check(const cmodel::Config& config, const std::vector<std::uint8_t>& bytes, Seen& seen) {
  const oracle::Rendering rendering = run_model(config, bytes);
  const std::vector<int> modes = tile_modes(bytes);
  const auto one = std::uint32_t{1} << config.composite_frac_bits;
  std::map<std::array<std::int64_t, 3>, Pixel> state;  // by tile, x, y
  for (const oracle::Event& event : rendering.events) {
    if (event.kind != oracle::Kind::Composite || modes.at(event.tile) == 2) continue;
    for (int i = 0; i < config.lanes * config.lanes; ++i) {
      const std::uint32_t* words = &event.payload[static_cast<std::size_t>(i) * 4];
      const Pixel now{words[0], words[1], words[2], words[3]};
      const std::array<std::int64_t, 3> key{event.tile, event.x + i % config.lanes, event.y + i / config.lanes};
      const Pixel before = state.try_emplace(key, Pixel{0, 0, 0, one}).first->second;
      ASSERT_LE(now[3], before[3]) << "transmittance rose";
      if (before[3] < static_cast<std::uint32_t>(config.freeze_below)) {
        ASSERT_EQ(now, before) << "a frozen pixel changed";  // N-6-6
        ++seen.frozen;
      }
      state[key] = now;
      ++seen.steps;
    }
  }
  for (const oracle::Picture& picture : rendering.tiles) {
    if (modes.at(picture.tile) == 2) continue;
    for (std::size_t i = 0; i < picture.words.size() / 4; ++i) {
      // N-6-8
      const auto width = static_cast<std::size_t>(picture.width);
      const auto known =
          state.find({picture.tile, static_cast<std::int64_t>(i % width), static_cast<std::int64_t>(i / width)});
      ASSERT_EQ(picture.words[i * 4 + 3] + (known != state.end() ? known->second[3] : one), one)
          << "tile " << picture.tile << ", pixel " << i;
      ++seen.alphas;
    }
  }
}

class Invariants : public ::testing::TestWithParam<std::string> {};

TEST_P(Invariants, HoldAtEveryTap) {
  cmodel::Config config = named_config(GetParam());
  // Alpha as an output word must be exact to be compared with T.
  config.pixel_int_bits = 1;
  config.pixel_frac_bits = config.composite_frac_bits;
  // Early termination, so that many pixels freeze and are hit again.
  config.freeze_below = 1 << (config.composite_frac_bits - 2);
  Random random(seed_or(9));
  Seen seen;
  for (int i = 0; i < 8; ++i) check(config, random_stream(symbols_of(config), random, 500).bytes, seen);
  std::printf("[figure] %s: composite steps = %llu, on frozen pixels = %llu, alphas = %llu, violations = 0\n",
              GetParam().c_str(), static_cast<unsigned long long>(seen.steps),
              static_cast<unsigned long long>(seen.frozen), static_cast<unsigned long long>(seen.alphas));
  EXPECT_GT(seen.steps, 0U);
  EXPECT_GT(seen.frozen, 0U);
  EXPECT_GT(seen.alphas, 0U);
}

INSTANTIATE_TEST_SUITE_P(Configs, Invariants, ::testing::Values("tiny", "base", "year2000"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace fastsplat::test
