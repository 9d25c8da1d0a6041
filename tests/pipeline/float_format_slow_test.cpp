// SPDX-License-Identifier: Apache-2.0
// Narrow floats against IEEE 754: every pair of 16-bit operands, and the compiler's own half type.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <vector>

#include "analysis/pipeline/float_format.hpp"
#include "base/error.hpp"
#include "base/parallel/parallel.hpp"
#include "tests/cmodel/random_helper.hpp"
#include "tests/pipeline/oracle/soft_float.hpp"

namespace fastsplat::stages {
namespace {

using Half = oracle::SoftFloat<5, 10>;
using Bfloat = oracle::SoftFloat<8, 7>;

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// All pairs up to the order of the operands and the sign of both.
template <class Soft>
void compare_all_pairs(const char* name) {
  const RoundToFloat narrow(float_format(name, "test"));
  std::vector<double> values;
  for (std::uint32_t word = 0; word < 65536; ++word) values.push_back(Soft::value(word));
  std::atomic<std::uint64_t> pairs{0}, different{0};
  parallel_for(32768, 0, [&](std::size_t number) {
    const auto a = static_cast<std::uint32_t>(number);
    std::uint64_t wrong = 0;
    for (std::uint32_t b = a; b < 32768; ++b) {
      const std::uint32_t minus = b | Soft::kSign;
      wrong += same(narrow(values[a] * values[b]), values[Soft::times(a, b)]) ? 0 : 1;
      wrong += same(narrow(values[a] + values[b]), values[Soft::plus(a, b)]) ? 0 : 1;
      wrong += same(narrow(values[a] + values[minus]), values[Soft::plus(a, minus)]) ? 0 : 1;
    }
    pairs += 3 * (32768 - a);
    different += wrong;
  });
  std::printf("[figure] %s: operations %llu, different %llu (limit 0)\n", name,
              static_cast<unsigned long long>(pairs.load()), static_cast<unsigned long long>(different.load()));
  EXPECT_EQ(pairs.load(), 3ULL * 32768 * 32769 / 2);
  EXPECT_EQ(different.load(), 0u);
}

TEST(FloatFormat, EveryPairOfHalvesIsIeee) { compare_all_pairs<Half>("fp16"); }
TEST(FloatFormat, EveryPairOfBfloatsIsIeee) { compare_all_pairs<Bfloat>("bf16"); }

TEST(FloatFormat, SoftFloatsAreTheCompilersHalves) {
#ifdef __FLT16_MANT_DIG__
  test::Random random(test::seed_or(2170));
  std::uint64_t different = 0, infinite = 0, subnormal = 0;
  constexpr int kPairs = 4'000'000;
  for (int i = 0; i < kPairs; ++i) {
    const auto a = static_cast<std::uint16_t>(random.between(0, 65535)),
               b = static_cast<std::uint16_t>(random.between(0, 65535));
    const auto x = std::bit_cast<_Float16>(a), y = std::bit_cast<_Float16>(b);
    for (const auto& [soft, compiler] : {std::pair(Half::plus(a, b), static_cast<_Float16>(x + y)),
                                         std::pair(Half::times(a, b), static_cast<_Float16>(x * y))}) {
      different += same(Half::value(soft), static_cast<double>(compiler)) ? 0 : 1;
      infinite += Half::is_infinite(soft) ? 1 : 0;
      subnormal += std::abs(Half::value(soft)) < std::ldexp(1.0, -14) ? 1 : 0;
    }
  }
  std::printf("[figure] operations %d, infinite %llu, subnormal or 0 %llu, different %llu (limit 0)\n", 2 * kPairs,
              static_cast<unsigned long long>(infinite), static_cast<unsigned long long>(subnormal),
              static_cast<unsigned long long>(different));
  EXPECT_EQ(different, 0u);
  EXPECT_GT(std::min(infinite, subnormal), 100000u);
#else
  GTEST_SKIP() << "this compiler has no _Float16";
#endif
}

// The nearest: exact bounds half a step around the result, of numbers with 12 bits and their squares and products.
TEST(FloatFormat, RootsAndQuotientsAreTheNearest) {
  const RoundToFloat narrow(float_format("fp16", "test"));
  std::uint64_t roots = 0, quotients = 0, wrong = 0;
  const auto half_step = [](double value) { return std::ldexp(1.0, std::max(std::ilogb(value), -14) - 11); };
  for (std::uint32_t word = 1; word < Half::kInfinity; ++word) {
    const double x = Half::value(word), root = narrow(std::sqrt(x)), half = half_step(root);
    wrong += (root - half) * (root - half) <= x && x <= (root + half) * (root + half) ? 0 : 1;
    ++roots;
  }
  test::Random random(test::seed_or(2171));
  while (quotients < 4'000'000) {
    const double x = Half::value(static_cast<std::uint32_t>(random.between(0, Half::kInfinity - 1))),
                 y = Half::value(static_cast<std::uint32_t>(random.between(1, Half::kInfinity - 1)));
    const double quotient = narrow(x / y);
    if (!(quotient < 65504.0) || quotient == 0.0) continue;
    const double half = half_step(quotient);
    wrong += (quotient - half) * y <= x && x <= (quotient + half) * y ? 0 : 1;
    ++quotients;
  }
  std::printf("[figure] roots %llu, quotients %llu, not the nearest %llu (limit 0)\n",
              static_cast<unsigned long long>(roots), static_cast<unsigned long long>(quotients),
              static_cast<unsigned long long>(wrong));
  EXPECT_EQ(wrong, 0u);
}

TEST(FloatFormat, EachHasItsRangeAndItsNumbers) {
  const struct {
    const char* name;
    double greatest, least_normal, least, above;  ///< above: what 4 times the greatest number becomes
  } facts[] = {{"fp16", 65504.0, 0x1p-14, 0x1p-24, HUGE_VAL},
               {"bf16", 0x1.FEp127, 0x1p-126, 0x1p-133, HUGE_VAL},
               {"tf19", 0x1.FFCp127, 0x1p-126, 0x1p-136, HUGE_VAL},
               {"e5m2", 57344.0, 0x1p-14, 0x1p-16, HUGE_VAL},
               {"e4m3", 448.0, 0x1p-6, 0x1p-9, 448.0},
               {"fp32", 0x1.FFFFFEp127, 0x1p-126, 0x1p-149, HUGE_VAL}};
  for (const auto& fact : facts) {
    const FloatFormat& format = float_format(fact.name, "test");
    const RoundToFloat narrow(format), flush(format, false);
    EXPECT_EQ(format.greatest(), fact.greatest) << fact.name;
    EXPECT_EQ(format.least_normal(), fact.least_normal) << fact.name;
    EXPECT_EQ(narrow(fact.greatest), fact.greatest) << fact.name;
    EXPECT_EQ(narrow(-4.0 * fact.greatest), -fact.above) << fact.name;
    EXPECT_EQ(narrow(fact.least), fact.least) << fact.name;
    EXPECT_EQ(narrow(0.5 * fact.least), 0.0) << fact.name << ": a tie to even";
    EXPECT_EQ(narrow(0.75 * fact.least), fact.least) << fact.name;
    EXPECT_EQ(flush(0.75 * fact.least_normal), 0.0) << fact.name;
    EXPECT_EQ(flush(fact.least_normal), fact.least_normal) << fact.name;
    EXPECT_TRUE(std::isnan(narrow(NAN))) << fact.name;
    EXPECT_EQ(RoundToFloat()(0.1), 0.1);
  }
  EXPECT_THROW(float_format("fp8", "--formats"), UserError);
}

}  // namespace
}  // namespace fastsplat::stages
