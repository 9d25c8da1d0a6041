// SPDX-License-Identifier: Apache-2.0
// Unit "pattern": a solid pattern's tint and lean at a pixel of a sheet, interpolated between the nodes of a table
// (docs/numerics.md, section 6.3).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cmodel/classify/pattern_tables.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/lane.hpp"

namespace fastsplat::cmodel {

class PatternUnit {
 public:
  explicit PatternUnit(const Config& config);

  /// Loads a checked load_table record of one of its tables.
  void load(Table table, std::span<const std::uint32_t> words);
  /// Whether the frame has a pattern; all functions below require one.
  bool loaded() const { return nodes_ != nullptr; }

  /// A pixel of the image in a sheet.
  struct Pixel {
    std::int64_t x = 0, y = 0, sheet = 0;
  };
  struct Sample {
    std::array<std::int64_t, 3> tint;  ///< R, G, B; One.16
    std::array<std::int64_t, 3> lean;  ///< right, down, ahead; b, S 10.16
  };
  Sample operator()(const Pixel& pixel) const;

  /// A sheet's sums with R, G and B tinted; tau unchanged (N-6.3-8).
  SheetWord tinted(const SheetWord& sums, const Pixel& pixel) const;
  /// A classified colour (One.14), tinted (N-6.3-9).
  std::int64_t tinted(std::int64_t colour, std::int64_t tint) const { return colour_(colour * tint).word; }

 private:
  using Node = std::array<std::int64_t, 4>;  ///< v, B_x, B_y, B_z

  Node node(std::size_t number) const;
  Node line(const Node& a, const Node& b, std::int64_t rest) const;
  Node between(const Pixel& pixel) const;
  std::array<std::int64_t, 3> tint(std::int64_t value) const;

  int node_bits_;
  Narrowing place_, line_, tint_, lean_, colour_, sum_;
  std::shared_ptr<const std::vector<std::uint32_t>> nodes_;  ///< NODES, shared by copies of the unit
  std::vector<std::uint32_t> words_;                         ///< PATTERN
};

}  // namespace fastsplat::cmodel
