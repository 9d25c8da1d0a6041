// SPDX-License-Identifier: Apache-2.0
// Cull groups, announced by cull_block records, and their splats (docs/stream.md, "Culling").
#pragma once

#include <cstdint>
#include <deque>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

/// Side of a tile's square cull cells in pixels: P, doubled until they number at most kMostCullCells (N-8-55).
inline constexpr std::int64_t kMostCullCells = 1024;
inline int cull_cell_pixels(const Config& config) {
  const auto cells = [&](int side) {
    return std::int64_t{(config.tile_width + side - 1) / side} * ((config.tile_height + side - 1) / side);
  };
  int side = config.lanes;
  while (cells(side) > kMostCullCells) side *= 2;
  return side;
}
/// Most cull groups with splats to come: one for each cull cell (S-cull-6).
inline std::int64_t cull_sets(const Config& config) {
  const int side = cull_cell_pixels(config);
  return std::int64_t{(config.tile_width + side - 1) / side} * ((config.tile_height + side - 1) / side);
}

/// A queue of cull groups with splats to come, oldest first, each with a note of its owner. Splats are found by tag: a
/// source may leave out splats of hidden groups, and tags go on as if they had come.
template <class Note>
class CullSets {
 public:
  /// Appends a group of `splats` splats from tag `tag` on, which follow those announced before.
  void announce(std::uint32_t tag, std::uint32_t splats, const Note& note) {
    if (splats == 0) return;
    if (open_.empty()) next_ = tag;
    open_.push_back({tag + splats, note});
  }
  /// For a splat that comes: the note of its group, or null without one. Valid until the next call.
  const Note* next(std::uint32_t tag) {
    const auto passed = [&] { return static_cast<std::int32_t>(tag - open_.front().end) >= 0; };
    while (!open_.empty() && passed()) open_.pop_front();
    if (open_.empty()) return nullptr;
    next_ = tag + 1;
    last_ = open_.front().note;
    if (next_ == open_.front().end) open_.pop_front();
    return &last_;
  }
  /// Splats of groups to come, if none is left out.
  std::uint32_t waiting() const { return open_.empty() ? 0 : open_.back().end - next_; }
  std::size_t open() const { return open_.size(); }
  void clear() { open_.clear(); }

 private:
  struct Open {
    std::uint32_t end;  ///< tag after its last splat
    Note note;
  };
  std::deque<Open> open_;
  std::uint32_t next_ = 0;  ///< tag of the next splat to come
  Note last_{};
};

}  // namespace fastsplat::cmodel
