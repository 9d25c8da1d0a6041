// SPDX-License-Identifier: Apache-2.0
// Numbers that a format of Gaussians holds; its writer clamps others.
#pragma once

#include <algorithm>

namespace fastsplat::scene {

struct StoredRange {
  double low, high;
  double slack;  ///< rounding error that does not count as clamping

  bool holds(double value) const { return value >= low - slack && value <= high + slack; }
  double clamp(double value) const { return std::clamp(value, low, high); }
};

}  // namespace fastsplat::scene
