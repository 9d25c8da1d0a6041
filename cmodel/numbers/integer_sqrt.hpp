// SPDX-License-Identifier: Apache-2.0
// floor(sqrt(v)) of a word: eight bits from a table, two Newton steps in integers, one correction.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace fastsplat::cmodel {

/// For t = 64..255 an a with (a - 1)^2 < m < (a + 1)^2 for every 16-bit word m of 256 t .. 256 t + 255. It is f =
/// floor(sqrt(256 t)) if 256 t is a square, else f + 1. (For a square, 256 t + 255 < (f + 1)^2, since f >= 128; in the
/// other case it is below (f + 2)^2 all the more.)
consteval std::array<std::uint16_t, 192> sqrt_seeds() {
  std::array<std::uint16_t, 192> seeds{};
  std::uint32_t f = 128;
  for (std::uint32_t t = 64; t < 256; ++t) {
    while ((f + 1) * (f + 1) <= 256 * t) ++f;
    seeds[t - 64] = static_cast<std::uint16_t>(f * f == 256 * t ? f : f + 1);
  }
  return seeds;
}
inline constexpr std::array<std::uint16_t, 192> kSqrtSeeds = sqrt_seeds();

/// The largest s with s * s <= v.
///
/// n is v shifted by an even number of bits into 2^62 .. 2^64 - 1: its root is v's, shifted by half as many. Let m be
/// the first 2d + 2 bits of n and r = sqrt(m). An a is accurate to e bits if (a - 1)^2 < (m >> 2(d - e)) < (a + 1)^2.
/// One step makes it accurate to d = 2e + 1 bits. Let A = a 2^(d-e), so |A - r| <= 2^(d-e). Newton's
/// x = (A + m / A) / 2 is too large by (A - r)^2 / (2 A) <= 2^(d-e) / (2 a) <= 1, as a >= 2^e. Equality does not occur:
/// |A - r| < 2^(d-e), since both inequalities above are strict. Rounded down, x is
/// a' = a 2^(d-e-1) + ((m >> (d-e+1)) / a), which is within 1 of r. The seed is accurate to 7 bits, the steps' results
/// to 15 and 31, all of n.
constexpr std::uint64_t integer_sqrt(std::uint64_t v) {
  if (v == 0) return 0;
  const int half = std::countl_zero(v) / 2;
  const std::uint64_t n = v << (2 * half);
  std::uint32_t near = kSqrtSeeds[(n >> 56) - 64];
  near = (near << 7) + static_cast<std::uint32_t>(n >> 41) / near;
  const std::uint64_t root = (std::uint64_t{near} << 15) + (n >> 17) / near;
  // root is right or one too large. The square of 2^32 wraps to 0, and the comparison is still right.
  return (root - (root * root - 1 >= n ? 1 : 0)) >> half;
}

}  // namespace fastsplat::cmodel
