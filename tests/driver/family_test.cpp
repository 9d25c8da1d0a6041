// SPDX-License-Identifier: Apache-2.0
// The driver of every kind of index against docs/numerics.md, sections 4 and 8: tables and records, word by word.
#include <gtest/gtest.h>

#include <cmath>

#include "driver/config/config_file.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/tables.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/driver/oracle_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::IndexKind;
using test::name_of;

constexpr IndexKind kOthers[] = {IndexKind::Linear, IndexKind::Squared, IndexKind::SquaredElliptic, IndexKind::Blit2d,
                                 IndexKind::Separable};

class DriverFamily : public ::testing::TestWithParam<IndexKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, DriverFamily, ::testing::ValuesIn(kOthers),
                         [](const auto& param_info) { return name_of(param_info.param); });

TEST_P(DriverFamily, EveryBeatIsThePages) {
  test::Random random(test::seed_or(71));
  OracleFigures figures;
  compare_random_frames_of(GetParam(), random, 1, 16, figures);
  print_and_expect_equal(figures);
  EXPECT_GT(figures.frames, 50U);
  EXPECT_GT(figures.met.several_sets, 0U);
  EXPECT_GT(figures.met.carried_words, 0U);
}

// A scale has 24 bits. It is at least the value that it stands for, and larger by less than a bit (N-4.1-3, N-4.2-4).
TEST(FamilyTables, ScalesAreRoundedUp) {
  const auto config = load_config("base");
  test::Random random(test::seed_or(72));
  double most = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const auto power = static_cast<int>(random.between(-39, 23));
    const double v = std::ldexp(1.0 + static_cast<double>(random.next() >> 11) * 0x1p-53, power);
    const Scale scale = scale_of(v, config);
    const double made = std::ldexp(static_cast<double>(scale.c), -static_cast<int>(scale.h));
    ASSERT_GE(made, v);
    most = std::max(most, (made - v) / v);
  }
  figure("largest relative excess of a scale, bits of 2^-23", most * 0x1p23);
  EXPECT_LT(most, 0x1p-23);
}

// A whole radius: the pixel that lies on the rim itself has no weight (N-4.5-3).
TEST(FamilyTables, TheRimOfAnAxisIsOutside) {
  auto config = load_config("base");
  config.index_kind = static_cast<int>(IndexKind::Separable);
  const auto table = set_table(config, scene::kernel_by_name("gauss2"), 0, 4.0, 0);
  ASSERT_EQ(table.radius.rho, 4U * 64U);
  ASSERT_EQ(table.words.size(), 64U * 8U);
  EXPECT_EQ(table.words[7], 0U) << "phase 0, column 7: d = 8 K - 4 K";
  EXPECT_GT(table.words[6], 0U);
  figure("word next to the rim", table.words[6]);
}

// linear: by area, the words' sum is that of the samples to within half of the last ring (N-4.1-5).
TEST(FamilyTables, LinearPreservesTheSumByArea) {
  int compared = 0;
  double worst = 0.0;
  for (const int frac_bits : {4, 8, 10, 14, 16})
    for (const int entries : {64, 256, 1024, 2048}) {
      auto config = load_config("base");
      config.index_kind = static_cast<int>(IndexKind::Linear);
      config.radial_entries = entries;
      config.radial_frac_bits = frac_bits;
      const auto kernel = scene::kernel_by_name("gauss2");
      const auto words = radial_table(config, kernel).words;
      double sum = 0.0;
      for (std::size_t t = 0; t < words.size(); ++t) {
        const double rho = kernel.radius() * (static_cast<double>(t) + 0.5) / entries;
        sum += (words[t] - std::ldexp(kernel.footprint(rho * rho) / kernel.peak(), frac_bits)) *
               (2.0 * static_cast<double>(t) + 1.0);
      }
      worst = std::max(worst, std::abs(sum) / (entries - 0.5));
      ++compared;
    }
  figure("tables compared", compared);
  figure("worst excess by area, of the last ring's half (limit 1)", worst);
  EXPECT_LE(worst, 1.0);
}

}  // namespace
}  // namespace fastsplat::driver
