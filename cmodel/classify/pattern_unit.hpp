// Unit "pattern": a solid pattern's tint and lean at a pixel of a sheet, between the nodes of a table that the driver
// loads (docs/numerics.md, section 6.3).
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

  /// The words of a checked load_table record of one of its tables.
  void load(Table table, std::span<const std::uint32_t> words);
  /// Whether the frame has a pattern; without one nothing below may be asked.
  bool loaded() const { return nodes_ != nullptr; }

  /// Where a pixel of the image lies in a sheet.
  struct Pixel {
    std::int64_t x = 0, y = 0, sheet = 0;
  };
  struct Sample {
    std::array<std::int64_t, 3> tint;  ///< R, G, B; One.16
    std::array<std::int64_t, 3> lean;  ///< right, down, ahead; b, S 10.16
  };
  Sample operator()(const Pixel& pixel) const;

  /// What section 6 takes of a sheet of colours: R, G, B of the sums, tinted; tau as it is.
  SheetWord tinted(const SheetWord& sums, const Pixel& pixel) const;
  /// A classified colour (One.14), tinted.
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
