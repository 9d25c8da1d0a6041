// SPDX-License-Identifier: Apache-2.0
// Narrowing of doubles: on words it equals the device's.
#include "analysis/pipeline/real_narrowing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::stages {
namespace {

TEST(RealNarrowing, OnWordsItIsTheDevicesOwn) {
  fastsplat::test::Random random(fastsplat::test::seed_or(11));
  std::uint64_t compared = 0, inexact = 0, cut = 0;
  for (int n = 0; n < 300; ++n) {
    const cmodel::Config config = fastsplat::test::random_config(random);
    for (std::size_t s = 0; s < cmodel::kSiteCount; ++s) {
      const auto site = static_cast<cmodel::Site>(s);
      if (cmodel::is_sum(site)) continue;  // they are cut, not rounded
      const cmodel::Narrowing words = cmodel::narrowing(config, site);
      const RealNarrowing reals(words);
      const int bits = std::min(50, words.from_frac() + 3);
      for (int i = 0; i < 40; ++i) {
        const std::int64_t word = random.between(-(std::int64_t{1} << bits), std::int64_t{1} << bits);
        const cmodel::Narrowed narrowed = words(word);
        const double value = reals(std::ldexp(static_cast<double>(word), -words.from_frac()));
        ASSERT_EQ(value, std::ldexp(static_cast<double>(narrowed.word), -words.to().frac_bits))
            << cmodel::facts(site).name << " of " << word;
        ++compared;
        inexact += narrowed.inexact ? 1 : 0;
        cut += narrowed.overflow ? 1 : 0;
      }
    }
  }
  std::printf("[figure] words compared = %llu, of them inexact %llu, cut %llu\n",
              static_cast<unsigned long long>(compared), static_cast<unsigned long long>(inexact),
              static_cast<unsigned long long>(cut));
  EXPECT_GT(inexact, 10000u);
  EXPECT_GT(cut, 10000u);
}

}  // namespace
}  // namespace fastsplat::stages
