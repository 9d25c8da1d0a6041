// SPDX-License-Identifier: Apache-2.0
// Unit "density stage": the ring of live sheets of a tile of densities. It classifies each sheet between its
// neighbours, pixel by pixel, into sums that are composited like a sheet of colours (docs/numerics.md, section 6.2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "cmodel/classify/classify_unit.hpp"
#include "cmodel/classify/density_ring.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

class DensityStage {
 public:
  explicit DensityStage(const Config& config) : lanes_(config.lanes), classify_(config) {}

  /// Loads a checked load_table record of one of its tables.
  void load(Table table, std::span<const std::uint32_t> words) { classify_.load(table, words); }
  /// The frame's solid pattern, which also tints sheets of colours.
  const PatternUnit& pattern() const { return classify_.pattern(); }
  /// Halo: pixels that a sheet holds on each side of the tile.
  static int halo(Mode mode) { return holds_densities(mode) ? 1 : 0; }
  void begin_tile(const BeginTile& tile, const BeginFrame& frame) {
    tile_ = tile;
    frame_width_ = frame.width;
    frame_height_ = frame.height;
    ring_.begin_tile(tile.width + 2, tile.height + 2);
  }
  /// Ends sheet `number`, which is in `splatted`: that has drain(visit(bx, by)), at(x, y) with the halo's first pixel
  /// at (0,0), and is clear after it. For the sheet that waited, calls pixel(sums, x, y) for the tile's pixels of each
  /// dirty block, then block(x, y, sheet number) with the block's first pixel, perhaps in the halo.
  template <class Buffer, class Pixel, class Block>
  void end_sheet(Buffer& splatted, std::uint32_t number, Pixel pixel, Block block) {
    ring_.end_sheet(splatted, number, lanes_, [&](const auto&... sheets) { visit(sheets..., pixel, block); });
  }
  /// The same for the last sheet, which nothing follows.
  template <class Pixel, class Block>
  void end_tile(Pixel pixel, Block block) {
    ring_.end_tile([&](const auto&... sheets) { visit(sheets..., pixel, block); });
  }

 private:
  DensitySlope slope(const DensitySheet& before, const DensitySheet& here, const DensitySheet& behind, int x,
                     int y) const {
    // One-sided at the image's edges, and doubled (N-6.2-9).
    const bool left = tile_.x + x == 0, right = tile_.x + x == frame_width_ - 1;
    const bool top = tile_.y + y == 0, bottom = tile_.y + y == frame_height_ - 1;
    const int i = x + 1, j = y + 1;
    const std::int64_t across = here.at(right ? i : i + 1, j) - here.at(left ? i : i - 1, j);
    const std::int64_t down = here.at(i, bottom ? j : j + 1) - here.at(i, top ? j : j - 1);
    return {.x = left || right ? 2 * across : across,
            .y = top || bottom ? 2 * down : down,
            .z = behind.at(i, j) - before.at(i, j)};
  }
  template <class Pixel, class Block>
  void visit(const DensitySheet& before, const DensitySheet& here, const DensitySheet& behind, Pixel pixel,
             Block block) const {
    for (const auto& [bx, by] : here.blocks()) {
      const int left = bx * lanes_ - 1, top = by * lanes_ - 1;
      const int x1 = std::min(tile_.width, left + lanes_), y1 = std::min(tile_.height, top + lanes_);
      for (int y = std::max(top, 0); y < y1; ++y) {
        for (int x = std::max(left, 0); x < x1; ++x) {
          pixel(classify_(static_cast<std::uint32_t>(here.at(x + 1, y + 1)), slope(before, here, behind, x, y),
                          tile_.x + x, tile_.y + y, here.number()),
                x, y);
        }
      }
      block(left, top, here.number());
    }
  }

  int lanes_;
  ClassifyUnit classify_;
  DensityRing ring_;
  BeginTile tile_;
  int frame_width_ = 0, frame_height_ = 0;
};

}  // namespace fastsplat::cmodel
