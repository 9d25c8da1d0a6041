// SPDX-License-Identifier: Apache-2.0
// Narrow floating-point numbers beside the device's integers (docs/floats.md): formats, and rounding to them.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace fastsplat::stages {

/// A binary format as IEEE 754 builds them: sign, biased exponent, fraction with a hidden bit.
struct FloatFormat {
  std::string_view name = "fp16";
  int exponent_bits = 5, fraction_bits = 10;
  /// The largest exponent holds infinities and NaN; what is too large becomes an infinity. Otherwise it holds numbers,
  /// but for its last word, which is NaN; what is too large becomes the largest number (OCP's E4M3, saturating).
  bool infinite = true;

  int bias() const { return (1 << (exponent_bits - 1)) - 1; }
  double least_normal() const { return std::ldexp(1.0, 1 - bias()); }
  double greatest() const;
  bool operator==(const FloatFormat&) const = default;
};

/// fp16 (binary16), bf16, tf19, e5m2, e4m3, fp32 (binary32).
const std::vector<FloatFormat>& float_formats();
/// Throws UserError (Usage) for an unknown name; `where`: the flag.
const FloatFormat& float_format(std::string_view name, const std::string& where);

/// Rounds doubles to the nearest number of a format, ties to even. The result of +, -, *, / or sqrt of numbers of the
/// format, computed as a double and rounded here, is IEEE 754's: a double has more than twice the bits and two more.
/// Without a format it returns its argument.
class RoundToFloat {
 public:
  RoundToFloat() = default;
  /// Without `subnormals`, results below the least normal number are 0.
  explicit RoundToFloat(const FloatFormat& format, bool subnormals = true)
      : on_(true),
        subnormals_(subnormals),
        dropped_(52 - format.fraction_bits),
        least_normal_(format.least_normal()),
        greatest_(format.greatest()),
        step_(std::ldexp(least_normal_, -format.fraction_bits)),
        beyond_(format.infinite ? std::numeric_limits<double>::infinity() : greatest_) {}

  bool on() const { return on_; }
  double operator()(double value) const {
    if (!on_ || value == 0.0) return value;
    if (std::abs(value) < least_normal_) {
      // Steps of equal size. The factor is a power of two.
      const double rounded = std::nearbyint(value / step_) * step_;
      return subnormals_ || std::abs(rounded) >= least_normal_ ? rounded : std::copysign(0.0, value);
    }
    if (!std::isfinite(value)) return std::isnan(value) ? value : std::copysign(beyond_, value);
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const std::uint64_t half = std::uint64_t{1} << (dropped_ - 1), odd = bits >> dropped_ & 1U;
    const auto rounded = std::bit_cast<double>((bits + (half - 1) + odd) & ~((half << 1) - 1));
    return std::abs(rounded) > greatest_ ? std::copysign(beyond_, value) : rounded;
  }

 private:
  bool on_ = false, subnormals_ = true;
  int dropped_ = 0;  ///< low bits of a double's fraction
  double least_normal_ = 0.0, greatest_ = 0.0, step_ = 1.0, beyond_ = 0.0;
};

}  // namespace fastsplat::stages
