// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cull/cull_tests.hpp"

namespace fastsplat::cmodel {

void CullTests::begin_tile(const BeginTile& tile) {
  unit_.begin_tile(tile.mode, tile.width, tile.height);
  sets_.clear();
  hidden_windows_.clear();
  tile_ = tile.tile;
  if (log_ != nullptr && on()) log_->tile(tile_) = {};
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
  const bool all = unit_.hidden({x, y, x + columns * lanes_, y + rows * lanes_});
  ++counts_.splat_tests;
  counts_.hidden_splats += all ? 1 : 0;
  add(all);
  hidden_windows_.assign(std::size_t{columns} * rows, 0);
  if (all || hidden_windows_.size() == 1) return all;
  for (std::size_t i = 0; i < hidden_windows_.size(); ++i) {
    const std::int64_t left = x + static_cast<std::int64_t>(i % columns) * lanes_,
                       top = y + static_cast<std::int64_t>(i / columns) * lanes_;
    const bool one = unit_.window_hidden({left, top, left + lanes_, top + lanes_});
    hidden_windows_[i] = one ? 1 : 0;
    counts_.hidden_windows += one ? 1 : 0;
    add(one);
  }
  return false;
}

void CullTests::end_sheet() {
  unit_.end_sheet();
  if (on() && log_ != nullptr) log_->tile(tile_).add_sheet(unit_.first_changed());
}

}  // namespace fastsplat::cmodel
