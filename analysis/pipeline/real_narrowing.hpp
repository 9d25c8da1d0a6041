// SPDX-License-Identifier: Apache-2.0
// The device's narrowing (docs/numerics.md, section 1) for numbers that need not be words; words narrow as in
// cmodel::Narrowing, bit for bit. Numbers are values, not words: 0.5 is 0.5 in any format.
#pragma once

#include <algorithm>
#include <cmath>

#include "cmodel/numbers/narrow.hpp"
#include "cmodel/numbers/sites.hpp"

namespace fastsplat::stages {

class RealNarrowing {
 public:
  /// Rounds as the site does and saturates. Exact for words below 2^52: all factors are powers of two.
  explicit RealNarrowing(const cmodel::Narrowing& site)
      : rounding_(site.rounding()),
        scale_(std::ldexp(1.0, site.to().frac_bits)),
        ulp_(std::ldexp(1.0, -site.to().frac_bits)),
        least_(static_cast<double>(site.to().min) * ulp_),
        greatest_(static_cast<double>(site.to().max) * ulp_) {}
  RealNarrowing(const cmodel::Config& config, cmodel::Site site) : RealNarrowing(cmodel::narrowing(config, site)) {}

  double operator()(double value) const { return cut(rounded(value * scale_) * ulp_); }
  /// Saturates only: for sums of words, which have the format's fraction bits already.
  double cut(double value) const { return std::clamp(value, least_, greatest_); }

  cmodel::Rounding rounding() const { return rounding_; }
  double scale() const { return scale_; }  ///< 2^frac_bits
  double greatest() const { return greatest_; }

 private:
  double rounded(double word) const {
    switch (rounding_) {
      case cmodel::Rounding::TRN:
        return std::floor(word);
      case cmodel::Rounding::RND:
        return std::floor(word + 0.5);
      case cmodel::Rounding::RND_CONV:
        break;
    }
    return std::nearbyint(word);  // ties to even, the default rounding mode
  }

  cmodel::Rounding rounding_;
  double scale_, ulp_, least_, greatest_;
};

}  // namespace fastsplat::stages
