// Sets of splats that cull_block records announce, and which splats belong to them (docs/stream.md, cull_block).
#pragma once

#include <cstdint>
#include <deque>

#include "cmodel/numbers/config.hpp"

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

/// A queue of sets with splats to come, oldest first, each with what its owner wants to know of it. It goes by tags,
/// for a source may leave out the splats of hidden sets, and tags go on as if they had come.
template <class Note>
class CullSets {
 public:
  /// Of `splats` splats, the first of which has the tag `tag`: the one behind those announced before.
  void announce(std::uint32_t tag, std::uint32_t splats, const Note& note) {
    if (splats == 0) return;
    if (open_.empty()) next_ = tag;
    open_.push_back({tag + splats, note});
  }
  /// A splat came: its set; null if it belongs to none. The pointer lives until the next call.
  const Note* next(std::uint32_t tag) {
    const auto passed = [&] { return static_cast<std::int32_t>(tag - open_.front().end) >= 0; };
    while (!open_.empty() && passed()) open_.pop_front();
    if (open_.empty()) return nullptr;
    next_ = tag + 1;
    last_ = open_.front().note;
    if (next_ == open_.front().end) open_.pop_front();
    return &last_;
  }
  /// Splats of sets to come, if none is left out.
  std::uint32_t waiting() const { return open_.empty() ? 0 : open_.back().end - next_; }
  std::size_t open() const { return open_.size(); }
  void clear() { open_.clear(); }

 private:
  struct Open {
    std::uint32_t end;  ///< tag behind its last splat
    Note note;
  };
  std::deque<Open> open_;
  std::uint32_t next_ = 0;  ///< tag of the next splat to come
  Note last_{};
};

}  // namespace fastsplat::cmodel
