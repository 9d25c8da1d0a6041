// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cull/cull_tests.hpp"

namespace fastsplat::cmodel {

void CullTests::begin_tile(const BeginTile& tile) {
  unit_.begin_tile(tile.mode, tile.width, tile.height);
  sets_.clear();
  hidden_windows_.clear();
  answers_ = log_ != nullptr && on() ? &log_->tile(tile.tile) : nullptr;
  if (answers_ != nullptr) *answers_ = {};
}

void CullTests::cull_block(const CullBlock& record) {
  if (!on()) return;
  const bool hidden = unit_.hidden(box_of(record));
  ++counts_.set_tests;
  counts_.hidden_sets += hidden ? 1 : 0;
  add(hidden);
  sets_.announce(record.tag, record.splats, hidden);
}

bool CullTests::dropped(std::uint32_t tag) {
  if (!on()) return false;
  const bool* hidden = sets_.next(tag);
  if (hidden == nullptr || !*hidden) return false;
  ++counts_.dropped;
  return true;
}

bool CullTests::hidden(std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows) {
  if (!on()) return false;
  const bool all = unit_.hidden(box_of_windows(x, y, columns, rows));
  ++counts_.splat_tests;
  counts_.hidden_splats += all ? 1 : 0;
  add(all);
  hidden_windows_.clear();
  return all;
}

void CullTests::test_windows(std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows) {
  if (!on() || columns * rows == 1) return;
  const PixelBox box = box_of_windows(x, y, columns, rows);
  // Windows beyond the tile are hidden. The others are seen if no block is opaque there; else each is tested.
  const CullTable& blocks = unit_.blocks();
  const PixelBox inside = blocks.inside(box);
  const bool seen = blocks.seen(inside);
  const auto first = static_cast<std::size_t>((inside.x0 - box.x0) / lanes_),
             last = static_cast<std::size_t>((inside.x1 - 1 - box.x0) / lanes_);
  const auto take = [&](bool one, std::size_t count) {
    hidden_windows_.resize(hidden_windows_.size() + count, one ? 1 : 0);
    counts_.hidden_windows += one ? count : 0;
    add(one, count);
  };
  for (std::int64_t top = box.y0; top < box.y1; top += lanes_) {
    if (top + lanes_ <= inside.y0 || top >= inside.y1) {
      take(true, columns);
      continue;
    }
    take(true, first);
    if (seen) {
      take(false, last + 1 - first);
    } else {
      for (std::size_t column = first; column <= last; ++column) {
        const std::int64_t left = box.x0 + static_cast<std::int64_t>(column) * lanes_;
        take(blocks.hidden({left, top, left + lanes_, top + lanes_}), 1);
      }
    }
    take(true, columns - 1 - last);
  }
}

void CullTests::end_sheet() {
  unit_.end_sheet();
  if (answers_ != nullptr) answers_->add_sheet(unit_.first_changed());
}

}  // namespace fastsplat::cmodel
