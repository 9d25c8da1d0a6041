// SPDX-License-Identifier: Apache-2.0
// The slices of a splat sum exactly to the splat, at any depth within its slab.
#include "driver/splats/slices.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

// N-8-66.
TEST(Slices, telescope_for_every_phase_width_and_configuration) {
  std::uint64_t sums = 0, wrong = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const auto one = static_cast<std::uint32_t>(config.colour_format().max);
    const SplatWords whole{one, one / 2 + 1, 1, one - 3};  // fits one record, so that no share saturates
    for (const double width : {0.5, 1.0, 2.0, 0.7}) {
      const Slices slices(config, scene::kernel_by_name("gauss2"), width, 40);
      for (std::int32_t depth = 0; depth <= slices.quantise_depth(40.0 * width); ++depth) {
        std::array<std::uint64_t, 4> sum{};
        for (int s = slices.first(depth); s <= slices.last(depth); ++s) {
          const Share share = slices.share(whole, depth, s);
          EXPECT_FALSE(share.saturated);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += share.words[c];
        }
        for (std::size_t c = 0; c < 4; ++c) {
          ++sums;
          wrong += sum[c] != whole[c] ? 1 : 0;
        }
      }
    }
  }
  figure("splats summed", static_cast<double>(sums));
  figure("splats whose slices do not sum to them", static_cast<double>(wrong));
  ASSERT_GT(sums, 0u);
  EXPECT_EQ(wrong, 0u);
}

// N-8-57.
TEST(Slices, grown_kernels_telescope_too_and_reach_as_far_as_they_say) {
  std::uint64_t sums = 0, outside = 0, wrong = 0;
  const auto config = load_config("base");
  const auto one = static_cast<std::uint32_t>(config.colour_format().max);
  const SplatWords whole{one, one / 2 + 1, 1, one - 3};
  const Slices slices(config, scene::kernel_by_name("gauss2"), 0.7, 60);
  for (const double growth : {1.0, 1.3, 2.0, 5.5}) {
    const DepthGrowth grown = slices.growth(static_cast<std::uint32_t>(std::floor(65536.0 / growth + 0.5)));
    const int reach = slices.reach(grown);
    for (std::int32_t depth = 0; depth <= slices.quantise_depth(40.0); depth += 7) {
      std::array<std::uint64_t, 4> sum{};
      const int first = slices.first(depth, grown);
      if (growth == 1.0) {
        EXPECT_EQ(first, slices.first(depth));
      }
      for (int s = 0; s < slices.count(); ++s) {
        const Share share = slices.share(whole, depth, s, grown);
        if (growth == 1.0) {
          EXPECT_EQ(share.words, slices.share(whole, depth, s).words);
        }
        if (s < first || s > first + reach) outside += share.empty() ? 0 : 1;
        for (std::size_t c = 0; c < 4; ++c) sum[c] += share.words[c];
      }
      for (std::size_t c = 0; c < 4; ++c) {
        ++sums;
        wrong += sum[c] != whole[c] ? 1 : 0;
      }
    }
  }
  figure("grown splats summed", static_cast<double>(sums));
  figure("whose slices do not sum to them", static_cast<double>(wrong));
  figure("slices out of their reach", static_cast<double>(outside));
  ASSERT_GT(sums, 10000u);
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(outside, 0u);
}

// N-8-57: deep, to its end.
TEST(Slices, a_kernel_grown_beyond_the_word_is_as_deep_as_the_page_says) {
  auto config = load_config("base");
  config.slice_phase_bits = 12;  // the deepest kernel there is
  const Slices slices(config, scene::kernel_by_name("gauss2"), 0.7, 60);
  const double step = std::ldexp(1.0, -config.slice_phase_bits), half_kernel = slices.growth(1U << 16).half * step;
  for (const std::uint32_t shrink : {1U, 2U, 1000U}) {
    const DepthGrowth grown = slices.growth(shrink);
    const double said = std::min(half_kernel * 65536.0 / shrink / step, std::ldexp(1.0, 28));
    figure("half depth", grown.half, "steps");
    EXPECT_NEAR(grown.half, said, 1.0) << shrink;
    EXPECT_EQ(slices.first(100, grown), 0) << shrink;
    EXPECT_EQ(slices.reach(grown), slices.count() - 1) << shrink;
  }
}

TEST(Slices, outlines_are_those_of_the_shares) {
  std::uint64_t compared = 0, empty = 0, above = 0, saturated = 0, wrong = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const auto one = static_cast<std::uint32_t>(config.colour_format().max);
    const Slices slices(config, scene::kernel_by_name("smooth"), 0.7, 40);
    const SplatWords splats[] = {{one, one / 2 + 1, 1, one - 3},
                                 {9, 20, 11, 21},
                                 {40, 39, 40, 40},
                                 {0, 0, 3, 0},
                                 {2, 1, 0, 1},
                                 {0, 0, 0, one},
                                 {one, 1, 1, one},
                                 {one, 7, 1, 3 * one}};
    for (const SplatWords& words : splats) {
      for (std::int32_t depth = 0; depth <= slices.quantise_depth(28.0); ++depth) {
        int s = slices.first(depth);
        slices.outlines(words, depth, s, slices.last(depth), [&](const Slices::Outline& outline) {
          const Slices::Outline expected = Slices::outline(slices.share(words, depth, s++));
          ++compared;
          empty += outline.largest == 0 ? 1 : 0;
          above += outline.excess != 0 ? 1 : 0;
          saturated += outline.saturated ? 1 : 0;
          wrong += outline.largest != expected.largest || outline.excess != expected.excess ||
                           outline.saturated != expected.saturated
                       ? 1
                       : 0;
        });
        wrong += s != slices.last(depth) + 1 ? 1 : 0;
      }
    }
  }
  figure("outlines compared", static_cast<double>(compared));
  figure("outlines that are not their share's", static_cast<double>(wrong));
  EXPECT_GT(empty, 0u);
  EXPECT_GT(above, 0u);
  EXPECT_GT(saturated, 0u);
  EXPECT_GT(compared, empty + above + saturated);
  EXPECT_EQ(wrong, 0u);
}

// N-8-68.
TEST(Slices, nothing_lies_outside_first_and_last) {
  const auto config = load_config("base");
  const Slices slices(config, scene::kernel_by_name("gauss2"), 0.5, 60);
  int empty = 0;
  for (std::int32_t depth = 0; depth <= slices.quantise_depth(30.0); depth += 7) {
    for (int s = 0; s < slices.count(); ++s) {
      if (s >= slices.first(depth) && s <= slices.last(depth)) continue;
      EXPECT_TRUE(slices.share({60000, 60000, 60000, 60000}, depth, s).empty()) << "depth " << depth << " slab " << s;
      ++empty;
    }
  }
  figure("slabs checked empty", empty);
  ASSERT_GT(empty, 0);
}

// N-8-66: v_c is cut to U 0.cf.
TEST(Slices, a_share_that_does_not_fit_a_record_says_so) {
  const auto config = load_config("base");
  const Slices slices(config, scene::kernel_by_name("gauss2"), 8.0, 2);
  const Share share = slices.share({1u << 17, 0, 0, 1u << 17}, slices.quantise_depth(4.0), 0);
  EXPECT_TRUE(share.saturated);
  EXPECT_EQ(share.words[0], 65535u);
}

// N-8-65.
TEST(Slices, slabs_thinner_than_a_depth_step_are_refused_with_both_numbers) {
  const auto config = load_config("base");
  try {
    Slices(config, scene::kernel_by_name("gauss2"), 0.001, 10);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    EXPECT_NE(std::string(error.what()).find("0.00390625"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0.001"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace fastsplat::driver
