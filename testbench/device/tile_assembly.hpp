// SPDX-License-Identifier: Apache-2.0
// Assembles finished tiles from a device's pixel beats; the beats that it took say which tile they belong to.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::testbench {

class TileAssembly {
 public:
  /// A tile that was begun and has not come out.
  struct Tile {
    cmodel::BeginTile begin;
    cmodel::TilePixels out;
    int taken = 0;  ///< pixel beats
  };

  TileAssembly(const cmodel::Config& config, cmodel::PixelSink& pixels) : lanes_(config.lanes), pixels_(pixels) {}

  /// A beat the device took. Returns the record that begins with it; nothing for the words of a table.
  std::optional<cmodel::Opcode> accept(const cmodel::Beat& beat);
  /// P pixels of 4 words; `last` ends the tile, whatever it lacks.
  void pixels(std::span<const std::uint32_t> words, bool last);
  void reset() {
    tiles_.clear();
    payload_left_ = 0;
  }

  /// All accepted tiles were delivered.
  bool complete() const { return tiles_.empty(); }
  /// Tiles that were begun and have not come out, and one of them; the pixels of tile(0) come next.
  std::size_t size() const { return tiles_.size(); }
  const Tile& tile(std::size_t number) const { return tiles_[number]; }

  /// The pixel, relative to the tile, at which its next pixel beat begins, and how many pixels of that beat lie in it.
  struct Place {
    std::int32_t x, y;
    int count;
  };
  Place next_place() const;

 private:
  int lanes_;
  cmodel::PixelSink& pixels_;
  std::deque<Tile> tiles_;
  std::uint64_t payload_left_ = 0;  ///< table beats to pass over
};

}  // namespace fastsplat::testbench
