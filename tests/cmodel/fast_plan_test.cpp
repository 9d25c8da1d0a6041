// SPDX-License-Identifier: Apache-2.0
// The fast unit's plan for a configuration and a frame's tables, at the limits that it accepts.
#include "cmodel/fast/fast_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "cmodel/fast/frame_tables.hpp"
#include "cmodel/fast/row_kernel.hpp"
#include "cmodel/fast/sample_plan.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Config;

// Lanes of 16 bits: both factors are positive words of them.
TEST(FastPlan, IsNarrowUpToFactorsOf15Bits) {
  Config config = named_config("small");
  int checked = 0;
  for (const int weight_bits : {13, 14, 15, 16}) {
    config.radial_frac_bits = weight_bits - config.radial_int_bits;
    ASSERT_FALSE(cmodel::first_violation(config));
    const auto plan = cmodel::fast::fast_plan(config);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->narrow, weight_bits <= 15) << weight_bits;
    ++checked;
  }
  std::printf("[figure] widths of weights planned = %d\n", checked);
}

/// Why samples of this configuration are not composited fast; "" if they are.
std::string why_not(const Config& config) {
  EXPECT_FALSE(cmodel::first_violation(config));
  const auto plan = cmodel::fast::fast_plan(config);
  if (!plan) return "no plan at all";
  const char* reason = "";
  const auto samples = cmodel::fast::sample_plan(config, *plan, &reason);
  EXPECT_EQ(samples.has_value(), std::strlen(reason) == 0);
  return reason;
}

TEST(SamplePlan, TakesWordsAndRoundingsUpToItsLanes) {
  const Config base = named_config("base");
  EXPECT_EQ(why_not(base), "");
  int refused = 0;
  const auto refuses = [&](const Config& config, const char* what) {
    EXPECT_NE(why_not(config).find(what), std::string::npos) << why_not(config);
    ++refused;
  };
  // Each site alone. Additive slabs drop nothing if sheet and transmittance have the same fraction bits.
  for (int Config::*const rounding : {&Config::rounding_fall, &Config::rounding_slab, &Config::rounding_light}) {
    Config config = base;
    config.*rounding = static_cast<int>(cmodel::Rounding::RND_CONV);
    refuses(config, "rounded to even");
  }
  for (int Config::*const bits : {&Config::composite_frac_bits, &Config::opacity_frac_bits}) {
    Config config = base;
    config.*bits = 17;
    if (cmodel::first_violation(config)) continue;
    refuses(config, "too wide for the sample lanes");
  }
  std::printf("[figure] configurations whose samples are refused = %d\n", refused);
  EXPECT_GE(refused, 4);
}

/// begin_frame and the tables of a device, with these slab factors.
std::optional<cmodel::fast::FrameTables> tables_of(const Config& config, const std::vector<std::uint32_t>& factor) {
  StreamWriter stream(symbols_of(config));
  const auto size = [](std::int64_t n) { return static_cast<std::size_t>(n); };
  const auto extent = static_cast<std::uint32_t>(config.lanes), phases = static_cast<std::uint32_t>(config.phases);
  stream.begin_frame(config.tile_width, config.tile_height, 1);
  stream.load_table(0, 0, extent * phases / 2, 0, std::vector<std::uint32_t>(size(phases) * extent, 0));
  stream.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(size(config.radial_entries), 1));
  stream.load_table(2, 0, 0, 0, factor);
  stream.begin_tile(0, 0, 0, 0, config.tile_width, config.tile_height);
  const auto beats = to_beats(stream.bytes());
  return cmodel::fast::frame_tables(config, std::span(beats).first(first_tile_beat(stream.bytes())));
}

// (tau + excess) * factor stays below 1.0 for every word of tau, with the largest factor that its segment has.
TEST(FrameTables, ExcessIsTheMostThatKeepsEveryOpacityBelowOne) {
  // Without vectors the fast unit accepts no frame, whatever its tables.
  if (!cmodel::fast::has_vectors()) GTEST_SKIP() << "this processor lacks the required vector instructions";
  const Config config = named_config("small");
  const int shift = config.opacity_remainder_bits();
  const std::uint64_t one = std::uint64_t{1} << (config.sheet_frac_bits + config.opacity_frac_bits);
  const auto words = std::uint64_t{1} << (config.sheet_int_bits + config.sheet_frac_bits);
  int holds = 0, does_not = 0;
  // Factors that fall like 1 / (tau + excess), from a small tau on.
  for (const std::uint64_t beside : {0U, 1U, 7U, 300U, 1000U, 5000U}) {
    std::vector<std::uint32_t> factor;
    for (std::uint64_t i = 0; i <= static_cast<std::uint64_t>(config.opacity_segments); ++i) {
      const std::uint64_t tau = ((i + 1) << shift) - 1 + beside;
      factor.push_back(
          static_cast<std::uint32_t>(std::min((one - 1) / tau, std::uint64_t{1} << config.opacity_frac_bits)));
    }
    std::uint64_t most = one;
    bool fits = true;
    for (std::uint64_t tau = 0; tau < words; ++tau) {
      const std::uint64_t largest = (one - 1) / factor[tau >> shift];
      fits = fits && largest >= tau;
      most = std::min(most, largest - tau);
    }
    const auto tables = tables_of(config, factor);
    ASSERT_TRUE(tables);
    EXPECT_EQ(tables->opacity_holds, fits) << beside;
    EXPECT_EQ(tables->opacity_excess, fits ? most : 0) << beside;
    (fits ? holds : does_not) += 1;
    // One more than the last segment allows, and the table guarantees nothing.
    const std::size_t last = factor.size() - 2;
    factor[last] = static_cast<std::uint32_t>((one - 1) / (words - 1) + 1);
    for (std::size_t i = 0; i < last; ++i) factor[i] = std::max(factor[i], factor[last]);
    const auto above = tables_of(config, factor);
    ASSERT_TRUE(above);
    EXPECT_FALSE(above->opacity_holds) << beside;
    ++does_not;
  }
  std::printf("[figure] tables of factors that hold = %d, that do not = %d\n", holds, does_not);
  EXPECT_GT(holds, 3);
}

}  // namespace
}  // namespace fastsplat::test
