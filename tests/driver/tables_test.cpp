// SPDX-License-Identifier: Apache-2.0
// The tables that the driver loads: preserved sums, exact squares, rims at the end of the support.
#include "driver/tables/tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "driver/config/config_file.hpp"
#include "driver/tables/density_tables.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

// N-4-3, N-4-4, N-4.7-4.
TEST(RadialTable, sum_is_the_rounded_sum_of_the_samples) {
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const scene::Kernel kernel = scene::kernel_by_name("gauss2");
    const auto words = radial_table(config, kernel).words;
    const bool lines = config.interpolates();
    ASSERT_EQ(words.size(), static_cast<std::size_t>(config.radial_entries) + (lines ? 1 : 0));
    double exact = 0.0;
    for (std::size_t t = 0; t < words.size(); ++t) {
      const double at = 8.0 * (static_cast<double>(t) + (lines ? 0.0 : 0.5)) / config.radial_entries;
      const double x = 4.0 / config.radial_entries, sample = std::exp(-at) * (lines ? std::tanh(x) / x : 1.0);
      exact += std::ldexp(sample, config.radial_frac_bits);
      // Largest remainder moves an entry by less than one word, saturation by more only where the format lacks 1.0.
      if (words[t] != config.weight_format().max) {
        EXPECT_LT(std::abs(words[t] - std::ldexp(sample, config.radial_frac_bits)), 1.0) << name << " entry " << t;
      }
    }
    const double sum = std::accumulate(words.begin(), words.end(), 0.0);
    figure("radial sum error, " + name, sum - exact, "words");
    EXPECT_LE(std::abs(sum - exact), config.radial_int_bits == 1 ? 0.5 : 0.5 + 1.0) << name;
  }
}

// N-4-2.
TEST(Rlut, exact_where_the_scale_is_a_whole_number) {
  auto config = load_config("base");
  // N 2^g / (r k)^2 = 1024 * 64 / (1 * 64)^2 = 16: every entry is 16 d^2 up to the rim.
  const auto table = rlut_table(config, 0, 1.0, 0);
  int compared = 0;
  for (int m = 0; m < config.phases; ++m) {
    for (int i = 0; i < 2; ++i) {
      const std::int64_t d = std::int64_t{i + 1} * config.phases - m - table.radius.rho;
      const std::int64_t expected = std::abs(d) < config.phases ? 16 * d * d : config.rlut_rim();
      EXPECT_EQ(table.words[static_cast<std::size_t>(m) * 8 + i], expected) << "m " << m << " i " << i;
      ++compared;
    }
  }
  figure("RLUT words compared", compared);
  ASSERT_EQ(compared, 128);
}

TEST(Rlut, a_footprint_of_radius_half_the_lanes_fits_one_window_at_every_phase) {
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const auto table = rlut_table(config, 0, config.lanes / 2.0, 0);
    EXPECT_EQ(table.words.size(), static_cast<std::size_t>(config.phases) * config.lanes) << name;
  }
}

TEST(SliceTable, ends_exactly_and_never_falls) {
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const auto phi = slice_table(config, scene::kernel_by_name("smooth"));
    EXPECT_EQ(phi.front(), 0u);
    EXPECT_EQ(phi.back(), 1u << config.slice_frac_bits);
    for (std::size_t i = 1; i < phi.size(); ++i) EXPECT_GE(phi[i], phi[i - 1]) << name << " step " << i;
  }
}

TEST(FactorTable, interpolation_error_is_within_the_second_derivative_bound) {
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const auto words = factor_table(config).words;
    const double step = std::ldexp(1.0, config.sheet_int_bits) / config.opacity_segments;
    double largest = 0.0;
    for (int n = 0; n < 16 * config.opacity_segments; ++n) {
      const double tau = (n + 0.5) / 16.0 * step;
      const auto segment = static_cast<std::size_t>(n / 16);
      const double part = tau / step - static_cast<double>(segment);
      const double linear = words[segment] * (1.0 - part) + words[segment + 1] * part;
      largest = std::max(largest, std::abs(std::ldexp(linear, -config.opacity_frac_bits) + std::expm1(-tau) / tau));
    }
    // |f''| <= 1/3 (at tau = 0), so a segment errs by step^2/24; each end is rounded to half a word.
    const double bound = step * step / 24.0 + std::ldexp(0.5, -config.opacity_frac_bits);
    figure("slab factor error, " + name, largest);
    EXPECT_LE(largest, bound * (1.0 + 1e-9)) << name;
  }
}

// N-8-92: two materials, red and blue, with a gap between them and at both ends: 129..179 of 512 and 333..383.
TEST(ClassifyTable, clear_entries_have_the_colour_of_the_nearest_that_is_seen) {
  auto description = view_of("shells:8", 16);
  description.classify = scene::ClassifyOrder::Post;
  auto scene = scene::build_scene(description);
  auto config = load_config("base");
  config.classify_segment_bits = 9;
  ASSERT_FALSE(cmodel::first_violation(config));
  const glm::dvec3 red(1.0, 0.0, 0.0), green(0.0, 1.0, 0.0), blue(0.0, 0.0, 1.0);
  scene.transfer_function.domain = scene::Domain::Range;
  scene.transfer_function.points = {{0.0, green, 0.0}, {0.25, red, 0.0},  {0.3, red, 0.5},
                                    {0.35, red, 0.0},  {0.5, green, 0.0}, {0.65, blue, 0.0},
                                    {0.7, blue, 0.5},  {0.75, blue, 0.0}, {1.0, green, 0.0}};
  const auto words_of = [&] { return density_tables(config, scene, scene::sheet_plan(scene).slabs)[0].words; };
  const auto words = words_of();
  ASSERT_EQ(words.size(), 4U * 513U);
  constexpr std::uint32_t kOne = 1U << 14;
  int seen = 0, wrong = 0;
  for (std::size_t i = 0; i <= 512; ++i) {
    const bool first = i > 128 && i<180, second = i> 332 && i < 384;
    seen += words[4 * i + 3] != 0 ? 1 : 0;
    EXPECT_EQ(words[4 * i + 3] != 0, first || second) << i;
    // 256 is as far from 179 as from 333: the higher of two is taken only if it is nearer.
    const bool is_red = i <= 256;
    wrong += words[4 * i] != (is_red ? kOne : 0) || words[4 * i + 1] != 0 || words[4 * i + 2] != (is_red ? 0 : kOne);
  }
  figure("entries that are seen", seen);
  figure("entries of another colour", wrong);
  EXPECT_EQ(seen, 51 + 51);
  EXPECT_EQ(wrong, 0);
  for (auto& point : scene.transfer_function.points) point.opacity = 0.0;
  for (const std::uint32_t word : words_of()) EXPECT_EQ(word, 0U) << "nothing is seen: black";
}

}  // namespace
}  // namespace fastsplat::driver
