// What rounding takes of a splat goes to the next splat behind it (docs/numerics.md, section 8, "carry"): the sum along
// a line of voxels is rounded once, and not each of its many thin splats to nothing.
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

/// What the sheets show of a word, in words: of V less than V where the products of thin splats and weights round to
/// nothing. A mean over the radial table, whose entries are even in area and so in the pixels of all sub-pixel places.
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

/// Of the lines of voxels that run across the slices, rows first_row..end_row-1 of them.
class RoundingCarry {
 public:
  /// Keeps a reference to `shown`.
  RoundingCarry(const Target& carried, const ShownWords& shown, int first_row, int end_row, int columns);

  /// The channel's word, cut to U 4.cf.
  Quantised operator()(double value, std::uint32_t line, std::size_t channel) {
    double& rest = rest_[line - first_][channel];
    const double sum = value * carried_.scale + rest;  // below 0 where more was shown than was asked
    const Quantised word = quantise(std::max(sum, 0.0) / carried_.scale, carried_);
    rest = word.saturated ? 0.0 : sum - shown_(word.word);
    return word;
  }

 private:
  Target carried_;
  const ShownWords& shown_;
  std::size_t first_;                        ///< line
  std::vector<std::array<double, 4>> rest_;  ///< per line, words
};

}  // namespace fastsplat::driver
