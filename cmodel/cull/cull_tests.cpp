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
  const PixelBox box{x, y, x + columns * lanes_, y + rows * lanes_};
  const bool all = unit_.hidden(box);
  ++counts_.splat_tests;
  counts_.hidden_splats += all ? 1 : 0;
  add(all);
  hidden_windows_.clear();
  const std::size_t windows = std::size_t{columns} * rows;
  if (all || windows == 1) return all;
  if (unit_.windows_seen(box)) {
    add(false, windows);
    return false;
  }
  for (std::int64_t top = box.y0; top < box.y1; top += lanes_) {
    for (std::int64_t left = box.x0; left < box.x1; left += lanes_) {
      const bool one = unit_.window_hidden({left, top, left + lanes_, top + lanes_});
      hidden_windows_.push_back(one ? 1 : 0);
      counts_.hidden_windows += one ? 1 : 0;
      add(one);
    }
  }
  return false;
}

void CullTests::end_sheet() {
  unit_.end_sheet();
  if (answers_ != nullptr) answers_->add_sheet(unit_.first_changed());
}

}  // namespace fastsplat::cmodel
