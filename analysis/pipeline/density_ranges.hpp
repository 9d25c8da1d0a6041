// SPDX-License-Identifier: Apache-2.0
// What the steps of DensitySteps can come to if their inputs are known to lie in ranges (docs/errors.md, section 3).
// All of them narrow ends as the steps narrow numbers, which is exact: rounding keeps the order of numbers.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "analysis/pipeline/density_steps.hpp"

namespace fastsplat::stages {

struct Range {
  double low = 0.0, high = 0.0;
  static Range about(double middle, double by) { return {middle - by, middle + by}; }
  /// The most that a number of the range is off `from`.
  double off(double from) const { return std::max(high - from, from - low); }
};

/// As DensityPixel.
struct DensityRange {
  Range density;
  std::array<Range, 3> across;
  int x = 0, y = 0;
  int sheet = 0;
};

/// Of a pixel: optical depth, and colours, which times optical depth are the sums.
struct ClassifiedRange {
  Range tau;
  std::array<Range, 3> colour;
  double rounded = 0.0;                                      ///< the most that step colour rounds a sum
  double largest = std::numeric_limits<double>::infinity();  ///< sums saturate here
};

class DensityRanges {
 public:
  /// Keeps a reference. `mixture` has no floats.
  DensityRanges(const DensitySteps& steps, const Mixture& mixture);

  /// Colours are missing where tau is 0.
  ClassifiedRange operator()(const DensityRange& pixel) const;

 private:
  using Ranges = std::array<Range, 3>;  ///< right, down, ahead

  void transfer(const Range& density, ClassifiedRange& out) const;
  Ranges slope(const DensityRange& pixel) const;
  Range length(const Ranges& slope) const;
  Range blend(const Ranges& slope, int sheet) const;
  Range facing(const Ranges& slope, const DensitySteps::Vector& real, const DensitySteps::Vector& words) const;

  const DensitySteps& steps_;
  const Mixture& mixture_;
  std::vector<double> bends_;  ///< of the real transfer function: densities between which it is monotonic
};

}  // namespace fastsplat::stages
