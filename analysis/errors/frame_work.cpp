// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/frame_work.hpp"

#include <algorithm>
#include <functional>
#include <queue>

namespace fastsplat::analysis {

void FrameWork::on_sheet(const cmodel::SheetCycles& sheet) { sheets_.push_back({sheet.windows, sheet.blocks}); }

void FrameWork::on_tile(const cmodel::TileCycles& tile) {
  tiles_.push_back({tiles_.empty() ? 0 : tiles_.back().last, sheets_.size(), tile.begun});
  end_ = tile.picture_to;
}

std::uint64_t FrameWork::ideal(const Tile& tile, int slices) const {
  std::uint64_t sum = 0, composites = 0;
  for (std::size_t i = tile.first; i < tile.last; ++i) {
    sum += std::max(sheets_[i].windows, composites);
    composites = sheets_[i].blocks * static_cast<std::uint64_t>(slices);
  }
  return sum + composites;
}

double FrameWork::work(int slices) const {
  double sum = 0.0;
  for (const Tile& tile : tiles_) sum += static_cast<double>(ideal(tile, slices));
  return sum;
}

double FrameWork::cycles(int devices, int slices) const {
  if (tiles_.empty()) return 0.0;
  // As dealt: each tile to the device that is free first. Until the first tile all do the same.
  std::priority_queue<double, std::vector<double>, std::greater<>> free;
  for (int i = 0; i < devices; ++i) free.push(static_cast<double>(tiles_.front().begun));
  double last = 0.0;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const std::uint64_t end = i + 1 < tiles_.size() ? tiles_[i + 1].begun : end_;
    const double counted = static_cast<double>(end) - static_cast<double>(tiles_[i].begun);
    const double done = free.top() + counted - static_cast<double>(ideal(tiles_[i], slices_)) +
                        static_cast<double>(ideal(tiles_[i], slices));
    free.pop();
    free.push(done);
    last = std::max(last, done);
  }
  return last;
}

}  // namespace fastsplat::analysis
