// SPDX-License-Identifier: Apache-2.0
// Unit "classify": turns a pixel's density and its differences to neighbours into the sums that a sheet of colours
// would hold (N-6.2-8 to N-6.2-13). Pure functions on tables that the driver loads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/classify/classify_tables.hpp"
#include "cmodel/classify/pattern_unit.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/lane.hpp"
#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

/// Differences of density words: right - left, below - above, behind - before. One-sided differences are doubled
/// (N-6.2-9).
struct DensitySlope {
  std::int64_t x = 0, y = 0, z = 0;
};

class ClassifyUnit {
 public:
  explicit ClassifyUnit(const Config& config);

  /// Loads a checked load_table record of one of its tables.
  void load(Table table, std::span<const std::uint32_t> words);

  const PatternUnit& pattern() const { return pattern_; }

  /// R, G, B, tau to composite at pixel (x,y) of the image in sheet `sheet`, U si.sf, from its density (U si.sf).
  SheetWord operator()(std::uint32_t density, const DensitySlope& slope, std::int32_t x, std::int32_t y,
                       std::uint32_t sheet) const;

 private:
  /// A piecewise linear table of words with `frac_bits` fraction bits, interpolated at `rest` of 2^rest_bits (N-6.2-7).
  class Lines {
   public:
    Lines(int frac_bits, int rest_bits);
    /// Value at `position`; `first`: channel of a table with several, `step`: words of an entry.
    std::int64_t at(std::span<const std::uint32_t> words, std::int64_t position, std::size_t first = 0,
                    std::size_t step = 1) const;

   private:
    int rest_bits_;
    Narrowing fall_;
  };
  /// The gradient g, and the factors that normalise it (N-6.2-11).
  struct Normal {
    std::array<std::int64_t, 3> g;  ///< right, down, ahead; S 4.16, after lean() S 14.16
    std::int64_t m = 0;             ///< |g| is sqrt(m) 2^half_shift words; 16 fraction bits, 1..4
    int half_shift = 0;             ///< e/2
    std::int64_t root = 0;          ///< 1/sqrt(m), One.14
  };
  /// Computes the factors that normalise normal.g; false if g is 0.
  bool measure(Normal& normal) const;
  std::int64_t length(const Normal& normal) const;  ///< |g|, U 5.24
  /// Adds the part of `by` (S 10.16) perpendicular to g, times |g|, to g (N-6.3-11).
  void lean(Normal& normal, const std::array<std::int64_t, 3>& by) const;
  std::int64_t facing(const Normal& normal, std::size_t vector) const;
  std::int64_t tilt(std::size_t axis, std::int32_t pixel) const;

  int sheet_frac_bits_;
  std::int64_t top_;  ///< density 1.0
  std::vector<std::uint32_t> classify_, root_, glint_, light_, sheets_;
  Lines colour_lines_, tau_lines_, root_lines_, glint_lines_;
  Narrowing across_, along_, tilt_, length_, share_, matt_, lit_, product_, leant_;
  PatternUnit pattern_;
};

}  // namespace fastsplat::cmodel
