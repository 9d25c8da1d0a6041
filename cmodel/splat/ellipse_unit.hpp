// SPDX-License-Identifier: Apache-2.0
// Unit "ellipse": the weights of a splat with its own shape (docs/numerics.md, section 4.6). A record has six
// coefficients, each narrowed once, at its first pixel. Every pixel's q is a sum of whole multiples of them, the same
// whatever window, bank or tile it is computed in.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/narrow.hpp"
#include "cmodel/splat/footprint.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

/// Place of a record's first pixel along one axis (N-4.6-3).
struct EllipseAxis {
  std::int32_t origin = 0;    ///< tile-relative pixel
  std::int64_t distance = 0;  ///< from the centre, 2^-pf pixel
};

/// `centre` is a word of S pi.pf, `offset` the record's left or top.
constexpr EllipseAxis ellipse_axis(const Config& config, std::int32_t centre, std::int32_t offset) {
  const int pf = config.position_frac_bits;
  const std::int32_t origin = (centre >> pf) + offset;
  return {.origin = origin, .distance = std::int64_t{origin} * (std::int64_t{1} << pf) - centre};
}

/// A dx^2 + B dx dy + C dy^2, h fraction bits. |dx|, |dy| <= 2^(9+pf).
constexpr std::int64_t exact_q(const EllipseShape& shape, std::int64_t dx, std::int64_t dy) {
  return std::int64_t{shape.a} * dx * dx + std::int64_t{shape.b} * dx * dy + std::int64_t{shape.c} * dy * dy;
}

/// q(i,j) = u0 + i u1 + i^2 u2 + j v1 + j^2 v2 + i j e modulo the word, f fraction bits (N-4.6-6).
struct EllipseCoefficients {
  std::int64_t u0 = 0, u1 = 0, u2 = 0, v1 = 0, v2 = 0, e = 0;
};

class EllipseUnit {
 public:
  explicit EllipseUnit(const Config& config) : config_(config), format_(config.ellipse_format()) {}

  EllipseCoefficients coefficients(const EllipseShape& shape, std::int64_t dx, std::int64_t dy) const;
  /// q at pixel (i,j), counted from the record's first pixel.
  std::int64_t q(const EllipseCoefficients& f, std::int64_t i, std::int64_t j) const {
    const auto times = [](std::int64_t n, std::int64_t word) {  // modulo 2^64, which the word divides
      return static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(word);
    };
    return wrapped(times(1, f.u0) + times(i, f.u1) + times(i * i, f.u2) + times(j, f.v1) + times(j * j, f.v2) +
                   times(i * j, f.e));
  }
  /// The same, not below 0, in whole steps of 2^-g radial table entries.
  std::uint64_t steps(const EllipseCoefficients& f, std::int64_t i, std::int64_t j) const {
    return static_cast<std::uint64_t>(std::max<std::int64_t>(q(f, i, j), 0)) >> format_.frac_bits;
  }
  /// The radial table's index at pixel (i,j); N or more at and beyond the rim.
  std::uint64_t index(const EllipseCoefficients& f, std::int64_t i, std::int64_t j) const {
    return steps(f, i, j) >> config_.rlut_guard_bits;
  }
  /// The P x P weights, row by row, of the window whose first pixel is pixel (column, row) of the record.
  template <class Observer>
  void window(const EllipseCoefficients& f, std::uint32_t column, std::uint32_t row, const RadialTable& radial,
              std::span<std::uint32_t> weights, Observer& observer) const {
    const auto lanes = static_cast<std::uint32_t>(config_.lanes);
    std::size_t lane = 0;
    for (std::uint32_t j = row; j < row + lanes; ++j) {
      for (std::uint32_t i = column; i < column + lanes; ++i) weights[lane++] = radial.weight(steps(f, i, j), observer);
    }
  }

 private:
  /// The word's bits, read as two's complement.
  std::int64_t wrapped(std::uint64_t sum) const {
    const int above = 64 - format_.word_bits;
    return static_cast<std::int64_t>(sum << above) >> above;
  }

  Config config_;
  Format format_;
};

}  // namespace fastsplat::cmodel
