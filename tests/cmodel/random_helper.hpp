// SPDX-License-Identifier: Apache-2.0
// A seeded generator that gives the same numbers on every platform (SplitMix64).
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace fastsplat::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  /// lo..hi, both included.
  std::int64_t between(std::int64_t lo, std::int64_t hi) {
    return lo + static_cast<std::int64_t>(next() % (static_cast<std::uint64_t>(hi - lo) + 1));
  }
  /// True once in n times.
  bool once_in(int n) { return between(1, n) == 1; }
  std::int64_t one_of(std::initializer_list<std::int64_t> values) {
    return values.begin()[static_cast<std::size_t>(between(0, static_cast<std::int64_t>(values.size()) - 1))];
  }

 private:
  std::uint64_t state_;
};

/// FASTSPLAT_SEED if set (to replay a failure), else `usual`; printed.
std::uint64_t seed_or(std::uint64_t usual);

}  // namespace fastsplat::test
