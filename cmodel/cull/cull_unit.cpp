// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cull/cull_unit.hpp"

namespace fastsplat::cmodel {
namespace {

std::array<CullTable, 2> tables(const Config& config, int cell) {
  const CullTable table(config.tile_width, config.tile_height, cell);
  return {table, table};
}

}  // namespace

CullUnit::CullUnit(const Config& config)
    : lanes_(config.lanes),
      by_pixels_(config.cull_map == static_cast<int>(CullMap::Pixel)),
      culls_(config.culls()),
      blocks_(tables(config, config.lanes)),
      pixels_(tables(config, 1)) {}

void CullUnit::begin_tile(Mode mode, int width, int height) {
  on_ = culls_ && culls_in(mode);
  if (!on_) return;
  width_ = width;
  height_ = height;
  for (CullTable& table : blocks_) table.begin_tile(width, height);
  block_map_.assign(static_cast<std::size_t>(blocks_[0].columns()) * static_cast<std::size_t>(blocks_[0].rows()), 0);
  changed_.fill(blocks_[0].rows());
  now_ = 1;
  if (!by_pixels_) return;
  for (CullTable& table : pixels_) table.begin_tile(width, height);
  pixel_map_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
}

void CullUnit::end_sheet() {
  if (!on_) return;
  // The sheet's own table is free now and becomes that of the sheet after the next.
  int& row = changed_[now_];
  const auto columns = static_cast<std::size_t>(blocks_[0].columns()), width = static_cast<std::size_t>(width_);
  blocks_[now_].build(row, [&](int x, int y) {
    return block_map_[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)] != 0;
  });
  if (by_pixels_) {
    pixels_[now_].build(row * lanes_, [&](int x, int y) {
      return pixel_map_[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] != 0;
    });
  }
  row = blocks_[now_].rows();
}

}  // namespace fastsplat::cmodel
