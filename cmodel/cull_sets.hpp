// Sets of splats that cull_block records announce, and which splats belong to them (docs/stream.md, cull_block).
#pragma once

#include <cstdint>
#include <deque>

#include "cmodel/config.hpp"

namespace fastsplat::cmodel {

/// Cells of a tile, each of so many pixels a side: P, or twice that and so on where the cells would be too many.
inline constexpr std::int64_t kMostCullCells = 1024;
inline int cull_cell_pixels(const Config& config) {
  const auto cells = [&](int side) {
    return std::int64_t{(config.tile_width + side - 1) / side} * ((config.tile_height + side - 1) / side);
  };
  int side = config.lanes;
  while (cells(side) > kMostCullCells) side *= 2;
  return side;
}
/// As many sets may wait for their splats.
inline std::int64_t cull_sets(const Config& config) {
  const int side = cull_cell_pixels(config);
  return std::int64_t{(config.tile_width + side - 1) / side} * ((config.tile_height + side - 1) / side);
}

/// A queue of sets with splats to come, oldest first, each with what its owner wants to know of it.
template <class Note>
class CullSets {
 public:
  void announce(std::uint32_t splats, const Note& note) {
    if (splats == 0) return;
    open_.push_back({splats, note});
    waiting_ += splats;
  }
  /// The next splat's set, one splat less; null if it belongs to none. The pointer lives until the next call.
  const Note* next() {
    if (open_.empty()) return nullptr;
    last_ = open_.front().note;
    --waiting_;
    if (--open_.front().left == 0) open_.pop_front();
    return &last_;
  }
  std::uint64_t waiting() const { return waiting_; }  ///< splats of sets to come
  std::size_t open() const { return open_.size(); }
  void clear() {
    open_.clear();
    waiting_ = 0;
  }

 private:
  struct Open {
    std::uint32_t left;
    Note note;
  };
  std::deque<Open> open_;
  std::uint64_t waiting_ = 0;
  Note last_{};
};

}  // namespace fastsplat::cmodel
