// SPDX-License-Identifier: Apache-2.0
// narrow() against the definition by exact division (N-1-3, N-1-4, N-1-5): every word around every small format
// (N-1-1), and 62-bit values.
#include "cmodel/numbers/narrow.hpp"

#include <gtest/gtest.h>

#include "tests/cmodel/oracle/number.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {
namespace {

struct Pair {
  cmodel::Format model;
  oracle::Words expected;
  bool wraps;
};

class Check {
 public:
  void all(std::int64_t value, int from_frac, const Pair& pair) {
    using enum cmodel::Rounding;
    using enum cmodel::Overflow;
    one<TRN, SAT>(value, from_frac, pair, oracle::Rounding::Trn, oracle::Overflow::Sat);
    one<RND, SAT>(value, from_frac, pair, oracle::Rounding::Rnd, oracle::Overflow::Sat);
    one<RND_CONV, SAT>(value, from_frac, pair, oracle::Rounding::RndConv, oracle::Overflow::Sat);
    if (!pair.wraps) return;
    one<TRN, WRAP>(value, from_frac, pair, oracle::Rounding::Trn, oracle::Overflow::Wrap);
    one<RND, WRAP>(value, from_frac, pair, oracle::Rounding::Rnd, oracle::Overflow::Wrap);
    one<RND_CONV, WRAP>(value, from_frac, pair, oracle::Rounding::RndConv, oracle::Overflow::Wrap);
  }
  std::uint64_t cases = 0, mismatches = 0;

 private:
  template <cmodel::Rounding R, cmodel::Overflow O>
  void one(std::int64_t value, int from_frac, const Pair& pair, oracle::Rounding rounding, oracle::Overflow overflow) {
    const cmodel::Narrowed got = cmodel::narrow<R, O>(value, from_frac, pair.model);
    const oracle::Narrowed want = oracle::narrow(rounding, overflow, value, from_frac, pair.expected);
    ++cases;
    if (got.word == want.word && got.inexact == want.inexact && got.overflow == want.overflow) return;
    if (mismatches++ == 0)
      ADD_FAILURE() << "value " << value << " / 2^" << from_frac << ", rounding " << static_cast<int>(R)
                    << ", overflow " << static_cast<int>(O) << ", to " << pair.model.min << ".." << pair.model.max
                    << " / 2^" << pair.model.frac_bits << ": got " << got.word << ", oracle "
                    << static_cast<std::int64_t>(want.word);
  }
};

void report(const char* what, const Check& check) {
  std::printf("[figure] narrow, %s: cases = %llu, mismatches = %llu (limit 0)\n", what,
              static_cast<unsigned long long>(check.cases), static_cast<unsigned long long>(check.mismatches));
  EXPECT_GT(check.cases, 0U);
  EXPECT_EQ(check.mismatches, 0U);
}

TEST(Narrow, EveryWordAroundEverySmallFormat) {
  std::vector<Pair> formats;
  for (int f = 0; f <= 4; ++f) {
    formats.push_back({cmodel::unit_format(f), oracle::one(f), false});
    for (int i = 0; i <= 3; ++i) formats.push_back({cmodel::unsigned_format(i, f), oracle::u(i, f), i + f > 0});
    for (int i = 1; i <= 3; ++i) formats.push_back({cmodel::signed_format(i, f), oracle::s(i, f), true});
  }
  Check check;
  for (const Pair& format : formats)
    for (int from_frac = 0; from_frac <= 6; ++from_frac)
      // 16 whole units of the finest input: twice the range of the widest format, on both sides.
      for (std::int64_t value = -1024; value <= 1024; ++value) check.all(value, from_frac, format);
  report("small formats", check);
}

TEST(Narrow, LargestValues) {
  constexpr std::int64_t kLimit = (std::int64_t{1} << 62) - 1;
  Random random(seed_or(5));
  Check check;
  for (int i = 0; i < 200000; ++i) {
    const int width = static_cast<int>(random.between(1, 32)), f = static_cast<int>(random.between(0, width));
    const Pair format = random.once_in(2) ? Pair{cmodel::unsigned_format(width - f, f), oracle::u(width - f, f), true}
                                          : Pair{cmodel::signed_format(width - f, f), oracle::s(width - f, f), true};
    // Drops bits only: widening a 62-bit value is outside the contract.
    const int from_frac = f + static_cast<int>(random.between(0, 48));
    const int magnitude = static_cast<int>(random.between(0, 62));
    std::int64_t value = random.between(-kLimit, kLimit) >> magnitude;
    if (random.once_in(8)) value = random.once_in(2) ? kLimit : -kLimit;
    check.all(value, from_frac, format);
  }
  report("62-bit values", check);
}

}  // namespace
}  // namespace fastsplat::test
