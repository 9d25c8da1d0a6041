// Sets of splats that cull_block records announce, and which splats belong to them (docs/stream.md, cull_block).
#pragma once

#include <cstdint>
#include <deque>

#include "cmodel/config.hpp"

namespace fastsplat::cmodel {

/// Cells of 2P x 2P pixels of a tile: as many sets may wait for their splats.
inline int cull_cell_pixels(const Config& config) { return 2 * config.lanes; }
inline std::int64_t cull_sets(const Config& config) {
  const std::int64_t side = cull_cell_pixels(config);
  return (config.tile_width + side - 1) / side * ((config.tile_height + side - 1) / side);
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
