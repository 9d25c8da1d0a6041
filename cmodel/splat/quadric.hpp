// SPDX-License-Identifier: Apache-2.0
// q = A dx^2 + B dx dy + C dy^2 over pixels, by additions alone from pixel to pixel: forward differences, exact in
// integers (N-4.2-3, N-4.3-4). A circle has A = C and B = 0; the squared distance A = C = 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

/// Coefficients of one radius set; 4 A C >= B^2, so q >= 0. The rim lies at q = N 2^shift.
struct Quadric {
  std::int64_t a = 0, b = 0, c = 0;
  int shift = 0;  ///< h: fraction bits of q below one radial table step
};

/// dx, dy in 1/K pixel.
constexpr std::int64_t quadric(const Quadric& f, std::int64_t dx, std::int64_t dy) {
  return f.a * dx * dx + f.b * dx * dy + f.c * dy * dy;
}
/// q(dx + n, dy) - q(dx, dy)
constexpr std::int64_t step_right(const Quadric& f, std::int64_t dx, std::int64_t dy, std::int64_t n) {
  return f.a * n * (2 * dx + n) + f.b * n * dy;
}
/// q(dx, dy + n) - q(dx, dy)
constexpr std::int64_t step_down(const Quadric& f, std::int64_t dx, std::int64_t dy, std::int64_t n) {
  return f.c * n * (2 * dy + n) + f.b * n * dx;
}
/// t: the radial table's index at q >= 0.
constexpr std::uint64_t quadric_index(std::int64_t q, int shift) { return static_cast<std::uint64_t>(q) >> shift; }

/// q in steps of 2^-guard_bits radial table entries, modulo 2^64.
constexpr std::uint64_t quadric_steps(std::int64_t q, int shift, int guard_bits) {
  const auto word = static_cast<std::uint64_t>(q);
  return shift < guard_bits ? word << (guard_bits - shift) : word >> (shift - guard_bits);
}

/// q at the P x P pixels of a window, computed from the first pixel. next() moves on by q(x+P) = q(x) + step, step +=
/// second difference. Only begin() multiplies.
class QuadricScan {
 public:
  explicit QuadricScan(const Config& config)
      : lanes_(config.lanes),
        pixel_(config.grid()),
        q_(static_cast<std::size_t>(lanes_) * static_cast<std::size_t>(lanes_)),
        leap_(q_.size()) {}

  /// Begins at the window whose first pixel lies (dx, dy) 1/K pixel from the centre.
  void begin(const Quadric& f, std::int64_t dx, std::int64_t dy) {
    const std::int64_t one = pixel_, wide = one * lanes_;
    std::int64_t row = quadric(f, dx, dy), down = step_down(f, dx, dy, one);
    std::int64_t row_right = step_right(f, dx, dy, one), row_leap = step_right(f, dx, dy, wide);
    second_leap_ = 2 * f.a * wide * wide;
    std::size_t lane = 0;
    for (int j = 0; j < lanes_; ++j) {
      std::int64_t q = row, right = row_right, leap = row_leap;
      for (int i = 0; i < lanes_; ++i, ++lane) {
        q_[lane] = q;
        leap_[lane] = leap;
        q += right;
        right += 2 * f.a * one * one;
        leap += 2 * f.a * wide * one;
      }
      row += down;
      down += 2 * f.c * one * one;
      row_right += f.b * one * one;
      row_leap += f.b * wide * one;
    }
  }
  /// Moves to the next window on the right.
  void next() {
    for (std::size_t lane = 0; lane < q_.size(); ++lane) {
      q_[lane] += leap_[lane];
      leap_[lane] += second_leap_;
    }
  }
  /// q at the window's pixels, row by row.
  std::span<const std::int64_t> values() const { return q_; }

 private:
  int lanes_;
  std::int64_t pixel_;              ///< K
  std::vector<std::int64_t> q_;     ///< of the current window
  std::vector<std::int64_t> leap_;  ///< q(x+P) - q(x)
  std::int64_t second_leap_ = 0;
};

}  // namespace fastsplat::cmodel
