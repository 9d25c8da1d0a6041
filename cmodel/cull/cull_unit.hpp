// SPDX-License-Identifier: Apache-2.0
// Unit "cull": tests which splats of a sheet the earlier ones, up to the last but one,
// hide (docs/numerics.md, section 6.1).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cmodel/cull/cull_table.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

/// Only modes 0 and 1 cull (N-6.1-2).
constexpr bool culls_in(Mode mode) { return mode == Mode::Exponential || mode == Mode::Additive; }

inline PixelBox box_of(const CullBlock& set) {
  return {set.x, set.y, std::int64_t{set.x} + set.width, std::int64_t{set.y} + set.height};
}

class CullUnit {
 public:
  explicit CullUnit(const Config& config);

  void begin_tile(Mode mode, int width, int height);
  /// Begins the next sheet of the tile. It is tested against the map that the sheet two before it left (N-6.1-4).
  void begin_sheet() {
    now_ = 1 - now_;
    first_changed_ = blocks_[0].rows();
  }
  /// Whether tests are made in this tile.
  bool on() const { return on_; }

  /// Whether all cells that the rectangle meets in the tile are opaque.
  bool hidden(const PixelBox& box) const { return cells()[now_].hidden(box); }
  /// The table of P x P blocks, whatever the map's cells: windows are tested against it (N-6.1-10).
  const CullTable& blocks() const { return blocks_[now_]; }

  /// Block (bx,by) of the open sheet was composited; frozen(x, y): whether a pixel is terminated.
  template <class Frozen>
  void composited(int bx, int by, Frozen frozen) {
    if (!on_) return;
    const int x0 = bx * lanes_, x1 = std::min(width_, x0 + lanes_), y0 = by * lanes_,
              y1 = std::min(height_, y0 + lanes_);
    bool opaque = true, changed = false;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const bool one = frozen(x, y);
        opaque = opaque && one;
        if (!by_pixels_ || !one) continue;
        auto& was =
            pixel_map_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
        changed = changed || was == 0;
        was = 1;
      }
    }
    auto& was = block_map_[static_cast<std::size_t>(by) * static_cast<std::size_t>(blocks_[0].columns()) +
                           static_cast<std::size_t>(bx)];
    changed = changed || (opaque && was == 0);
    was = opaque ? 1 : 0;
    if (!changed) return;
    first_changed_ = std::min(first_changed_, by);
    for (int& row : changed_) row = std::min(row, by);
  }
  /// First row of blocks in which a cell became opaque in this sheet; the number of rows if none did.
  int first_changed() const { return first_changed_; }
  /// Ends the sheet, after composited() for all of its blocks.
  void end_sheet();

  const CullTable& table() const { return cells()[now_]; }

 private:
  const std::array<CullTable, 2>& cells() const { return by_pixels_ ? pixels_ : blocks_; }

  int lanes_;
  bool by_pixels_, culls_;
  bool on_ = false;
  int width_ = 0, height_ = 0;
  std::array<CullTable, 2> blocks_, pixels_;         ///< by parity of the sheet
  std::vector<std::uint8_t> block_map_, pixel_map_;  ///< the current maps
  std::array<int, 2> changed_{};                     ///< first row of blocks to rebuild, for each table
  int first_changed_ = 0;
  std::size_t now_ = 0;
};

}  // namespace fastsplat::cmodel
