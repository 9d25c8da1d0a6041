// SPDX-License-Identifier: Apache-2.0
// Checks that two renderers drew the same picture: a peer that draws nothing would win every race.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "base/image.hpp"

namespace fastsplat::bench {

/// PSNR of the whole RGBA picture, peak 1; infinite for equal pictures, NaN for different sizes.
inline double psnr(const Image& a, const Image& b) {
  if (a.data.size() != b.data.size() || a.data.empty()) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    const double error = static_cast<double>(a.data[i]) - static_cast<double>(b.data[i]);
    squares += error * error;
  }
  return -10.0 * std::log10(squares / static_cast<double>(a.data.size()));
}

/// Pixels where both have an alpha above 0.5, as a share of those where either has; 0 if no pixel has.
inline double silhouette_overlap(const Image& a, const Image& b) {
  if (a.data.size() != b.data.size()) return 0.0;
  std::size_t both = 0, any = 0;
  for (std::size_t i = 3; i < a.data.size(); i += 4) {
    const bool in_a = a.data[i] > 0.5f, in_b = b.data[i] > 0.5f;
    both += in_a && in_b ? 1 : 0;
    any += in_a || in_b ? 1 : 0;
  }
  return any == 0 ? 0.0 : static_cast<double>(both) / static_cast<double>(any);
}

}  // namespace fastsplat::bench
