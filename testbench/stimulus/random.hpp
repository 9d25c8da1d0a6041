// SPDX-License-Identifier: Apache-2.0
// Seeded draws: the same seed gives the same numbers on every machine and library.
#pragma once

#include <cstdint>

#include "testbench/device/pattern.hpp"

namespace fastsplat::testbench {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix(seed)) {}

  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15ULL); }
  /// low..high, both included.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(next() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// True in `percent` of the draws.
  bool chance(int percent) { return between(0, 99) < percent; }

 private:
  std::uint64_t state_;
};

}  // namespace fastsplat::testbench
