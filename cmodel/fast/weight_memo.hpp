// SPDX-License-Identifier: Apache-2.0
// The weights of every footprint of a frame's tables, by radius set and phases: the weight unit's results for a whole
// splat, computed once per frame instead of once per pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/weight_unit.hpp"

namespace fastsplat::cmodel::fast {

/// Footprints of one radius set.
struct Shape {
  std::uint32_t rho = 0;       ///< support radius, 1/K pixel
  int padded = 0;              ///< Ea, pixels: the windows' coverage
  int extent = 0;              ///< pixels from the origin with a weight in any phase; <= Ea
  int pitch = 0;               ///< words from row to row: pitch_of(extent)
  std::uint32_t windows = 0;   ///< windows of one splat
  std::uint32_t heaviest = 0;  ///< largest weight, unshifted
  std::size_t first = 0;       ///< index in words_ of phases (0,0)
};

class WeightMemo {
 public:
  /// Weights are stored as words of 16 bits, shifted left by `weight_shift`.
  WeightMemo(const Config& config, WeightUnit& unit, std::uint32_t sets, int weight_shift);

  /// Most bytes that the footprints of one set take.
  static std::size_t bytes(const Config& config, std::uint32_t rho);

  std::uint32_t sets() const { return static_cast<std::uint32_t>(shapes_.size()); }
  const Shape& shape(std::uint32_t set) const { return shapes_[set]; }
  /// Number of the footprint with these phases.
  std::size_t number(std::uint32_t phase_x, std::uint32_t phase_y) const {
    return (static_cast<std::size_t>(phase_y) << phase_bits_) | phase_x;
  }
  /// The footprint's weights: extent rows of pitch words.
  const std::uint16_t* words(const Shape& shape, std::size_t number) const {
    return words_.data() + shape.first + number * (static_cast<std::size_t>(shape.extent) * shape.pitch);
  }
  /// Pixels with a weight above 0.
  std::uint32_t weighted(std::uint32_t set, std::size_t number) const {
    return weighted_[(static_cast<std::size_t>(set) << (2 * phase_bits_)) + number];
  }

 private:
  void fill(const Config& config, RlutUnit& unit, std::uint32_t set, int weight_shift);
  template <class Unit>
  void fill(const Config& config, Unit& unit, std::uint32_t set, int weight_shift);

  int phases_, phase_bits_, lanes_;
  std::vector<Shape> shapes_;
  std::vector<std::uint16_t> words_;
  std::vector<std::uint16_t> weighted_;
};

}  // namespace fastsplat::cmodel::fast
