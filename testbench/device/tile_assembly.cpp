// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/tile_assembly.hpp"

#include <algorithm>

namespace fastsplat::testbench {

std::optional<cmodel::Opcode> TileAssembly::accept(const cmodel::Beat& beat) {
  if (payload_left_ > 0) {
    --payload_left_;
    return std::nullopt;
  }
  const auto opcode = static_cast<cmodel::Opcode>(get(beat, cmodel::layout::kOpcode));
  payload_left_ = cmodel::announced_beats(beat);
  if (opcode == cmodel::Opcode::BeginTile) {
    const auto begin = std::get<cmodel::BeginTile>(cmodel::from_beat(beat));
    tiles_.push_back({.begin = begin,
                      .out = {.tile = begin.tile,
                              .x = begin.x,
                              .y = begin.y,
                              .width = begin.width,
                              .height = begin.height,
                              .words = {}},
                      .taken = 0});
    tiles_.back().out.words.reserve(static_cast<std::size_t>(begin.width) * begin.height * 4);
  }
  return opcode;
}

TileAssembly::Place TileAssembly::next_place() const {
  const Tile& tile = tiles_.front();
  const int beats_per_row = (tile.begin.width + lanes_ - 1) / lanes_;
  const int x = tile.taken % beats_per_row * lanes_;
  return {.x = x, .y = tile.taken / beats_per_row, .count = std::min(lanes_, tile.begin.width - x)};
}

void TileAssembly::pixels(std::span<const std::uint32_t> words, bool last) {
  if (tiles_.empty()) return;
  Tile& tile = tiles_.front();
  const auto inside = words.first(4 * static_cast<std::size_t>(next_place().count));
  tile.out.words.insert(tile.out.words.end(), inside.begin(), inside.end());
  ++tile.taken;
  if (!last) return;
  cmodel::TilePixels out = std::move(tile.out);
  out.words.resize(static_cast<std::size_t>(out.width) * out.height * 4);
  tiles_.pop_front();
  pixels_.on_tile(std::move(out));
}

}  // namespace fastsplat::testbench
