// SPDX-License-Identifier: Apache-2.0
// Every site of the driver rounds and saturates as docs/numerics.md, section 8 states: positions (N-8-36), whole splats
// (N-8-37), the carry (N-8-59), PHI (N-8-64), boundaries and depths (N-8-65).
#include "driver/tables/quantise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cmodel/splat/snap.hpp"
#include "driver/config/config_file.hpp"
#include "tests/cmodel/random_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

constexpr Site kSites[] = {Site::Position, Site::Depth, Site::Boundary, Site::Whole,     Site::Carried, Site::Phi,
                           Site::Rho,      Site::Rlut,  Site::Radial,   Site::RadialSum, Site::Factor};

/// The site's word of a value `parts`/4 of a unit above the word 3.
std::int64_t word_near_3(Site site, int parts, const cmodel::Config& config) {
  const Target to = target(site, config);
  return quantise(std::ldexp(3.0 + parts / 4.0, -to.to.frac_bits), to).word;
}

TEST(Quantise, halves_go_up_but_for_radius_radial_weights_and_what_is_carried) {
  int compared = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    for (const Site site : kSites) {
      for (int parts = 0; parts <= 4; ++parts, ++compared) {
        std::int64_t expected = parts < 2 ? 3 : 4;
        if (site == Site::Rho) expected = parts == 0 ? 3 : 4;
        // For a position finer than the phases the snap rounds the rest.
        const bool snapped = site == Site::Position && config.grid_bits() < config.position_frac_bits;
        if (site == Site::Radial || site == Site::Carried || snapped) expected = parts < 4 ? 3 : 4;
        EXPECT_EQ(word_near_3(site, parts, config), expected)
            << name << ", site " << static_cast<int>(site) << ", 3 + " << parts << "/4";
      }
    }
  }
  figure("values quantised", compared);
  ASSERT_GT(compared, 0);
}

TEST(Quantise, negative_halves_go_up) {
  const auto config = load_config("base");
  for (const Site site : {Site::Position, Site::Depth, Site::Boundary}) {
    const Target to = target(site, config);
    for (const auto& [value, word] : {std::pair{-2.75, -3}, {-2.5, -2}, {-2.25, -2}, {-2.0, -2}}) {
      EXPECT_EQ(quantise(std::ldexp(value, -to.to.frac_bits), to).word, word) << value;
    }
  }
}

// N-8-36: if the snap has bits to round, driver and snap together round a position once: no splat moves on average.
TEST(Quantise, a_position_is_rounded_once_whatever_the_snap_leaves_of_it) {
  constexpr int kPositions = 200000;
  test::Random random(14);
  double worst = 0.0;
  std::uint64_t twice = 0;
  for (const int phases : {1, 2, 4, 8, 16, 32, 64}) {
    auto config = load_config("base");
    config.phases = phases;
    const Target to = target(Site::Position, config);
    const auto rho = static_cast<std::uint32_t>(3 * phases);
    double moved = 0.0;
    for (int i = 0; i < kPositions; ++i) {
      const double x =
          std::ldexp(static_cast<double>(random.between(0, (std::int64_t{1} << 31) - 1)), -24);  // 0..128, finely
      const auto at = cmodel::snap(config, quantise_to<std::int32_t>(x, to), rho);
      const double snapped = (at.origin - 1) + static_cast<double>(at.phase + rho) / phases;
      moved += snapped - x;
      twice += phases < 64 && snapped != std::floor(x * phases + 0.5) / phases ? 1 : 0;
    }
    // Of uniform errors of one phase's width: 4 standard deviations of their mean.
    const double allowed = 4.0 / phases / std::sqrt(12.0 * kPositions);
    EXPECT_LT(std::abs(moved / kPositions), allowed) << phases << " phases";
    worst = std::max(worst, std::abs(moved / kPositions) / allowed);
  }
  figure("mean move of 200,000 splats over what chance allows, worst of 7 numbers of phases", worst);
  figure("positions rounded twice", static_cast<double>(twice));
  EXPECT_EQ(twice, 0U);
}

/// N-8-37, U 4.cf: the last word that fits is reached by rounding, the next one saturates and is counted.
TEST(Quantise, a_whole_splat_saturates_and_says_so) {
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const Target to = target(Site::Whole, config);
    const double largest = std::ldexp(16.0, config.colour_frac_bits) - 1.0;
    for (const auto& [above, saturated] : {std::pair{0.0, false}, {0.25, false}, {0.5, true}, {1e6, true}}) {
      const Quantised out = quantise(std::ldexp(largest + above, -config.colour_frac_bits), to);
      EXPECT_EQ(out.word, static_cast<std::int64_t>(largest)) << name << " + " << above;
      EXPECT_EQ(out.saturated, saturated) << name << " + " << above;
    }
  }
}

}  // namespace
}  // namespace fastsplat::driver
