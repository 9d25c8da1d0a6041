// SPDX-License-Identifier: Apache-2.0
// An exact sum of many words: 128 bits, two's complement, in two 64-bit words.
#pragma once

#include <cstdint>

namespace fastsplat::cmodel {

struct WideSum {
  std::uint64_t low = 0, high = 0;

  WideSum& operator+=(const WideSum& other) {
    low += other.low;
    high += other.high + (low < other.low ? 1 : 0);
    return *this;
  }
  void add(std::int64_t value) { *this += {static_cast<std::uint64_t>(value), value < 0 ? ~std::uint64_t{0} : 0}; }
  /// |value| < 2^62: the sum holds 2^3 of the largest squares, or 2^39 of the device's errors, which are at most 43
  /// bits long.
  void add_square(std::int64_t value) {
    const std::uint64_t size =
        value < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    const std::uint64_t b = size >> 32, a = size & 0xFFFFFFFFU;  // (a + b 2^32)^2 = a^2 + ab 2^33 + b^2 2^64
    *this += {a * a, 0};
    if (b == 0) return;
    const std::uint64_t ab = a * b;
    *this += {ab << 33, (ab >> 31) + b * b};
  }
  bool negative() const { return (high >> 63) != 0; }
  bool operator==(const WideSum&) const = default;
};

}  // namespace fastsplat::cmodel
