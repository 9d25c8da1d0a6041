// SPDX-License-Identifier: Apache-2.0
// Error diffusion along the traversal: the rounding error of a splat is added to the neighbour behind it
// (docs/numerics.md, N-8-38 to N-8-41). The sum along a run of thin splats survives, though each would round to 0.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "driver/tables/quantise.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::driver {

/// Mean value, in words, that the sheets show for a word V (N-8-40). It is less than V where products of thin splats
/// and weights round to 0. The mean is over the radial table, weighted by area and so by pixels at all sub-pixel
/// positions.
class ShownWords {
 public:
  ShownWords(const cmodel::Config& config, const scene::Kernel& kernel);
  double operator()(std::int64_t word) const {
    return word < static_cast<std::int64_t>(shown_.size()) ? shown_[static_cast<std::size_t>(word)]
                                                           : static_cast<double>(word);
  }

 private:
  std::array<double, 256> shown_{};
};

/// Error diffusion state of the lines of voxels across the slices, rows first_row..end_row-1. A line's splats come
/// front to back.
class RoundingCarry {
 public:
  struct Line {
    std::array<double, 4> rest{};  ///< per channel, words
    int slice = -2;                ///< slice of its last splat
    int run = 0;                   ///< splats since the last gap
  };

  /// Keeps a reference to `shown`.
  RoundingCarry(const Target& carried, const ShownWords& shown, int first_row, int end_row, int columns);

  /// The line of the next splat, which lies in `slice`.
  Line& next(std::uint32_t line, int slice);
  /// The channel's word, saturated to U 4.cf.
  Quantised operator()(double value, Line& line, std::size_t channel) const {
    double& rest = line.rest[channel];
    const double sum = value * carried_.scale + rest;  // below 0 if more was shown than required
    const Quantised word = quantise(std::max(sum, 0.0) / carried_.scale, carried_);
    rest = word.saturated ? 0.0 : sum - shown_(word.word);
    return word;
  }

 private:
  Target carried_;
  const ShownWords& shown_;
  std::uint32_t columns_, first_;  ///< lines per row; the first line
  std::vector<Line> lines_;
};

}  // namespace fastsplat::driver
