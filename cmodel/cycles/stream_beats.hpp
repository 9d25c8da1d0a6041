// SPDX-License-Identifier: Apache-2.0
// Beats that a source sends to a device, by kind of record (docs/stream.md).
#pragma once

#include <cstdint>

#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

struct StreamBeats {
  std::uint64_t splats = 0;  ///< circles and ellipses: one for each sheet and tile
  std::uint64_t cull_blocks = 0;
  std::uint64_t sheets = 0;  ///< begin_sheet and end_sheet
  std::uint64_t tiles = 0;   ///< begin_tile and end_tile
  std::uint64_t tables = 0;  ///< load_table and the words behind it
  std::uint64_t frame = 0;   ///< begin_frame and end_frame

  /// Counts a beat; `payload`: words of a table.
  void count(Opcode opcode, bool payload) { ++of(payload ? Opcode::LoadTable : opcode); }
  std::uint64_t total() const { return splats + cull_blocks + sheets + tiles + tables + frame; }
  /// visit(name, beats) in the order above.
  template <class Visit>
  void for_each(Visit visit) const {
    visit("splats", splats);
    visit("cull_blocks", cull_blocks);
    visit("sheets", sheets);
    visit("tiles", tiles);
    visit("tables", tables);
    visit("frame", frame);
  }

 private:
  std::uint64_t& of(Opcode opcode) {
    switch (opcode) {
      case Opcode::Splat:
      case Opcode::Ellipse:
        return splats;
      case Opcode::CullBlock:
        return cull_blocks;
      case Opcode::BeginSheet:
      case Opcode::EndSheet:
        return sheets;
      case Opcode::BeginTile:
      case Opcode::EndTile:
        return tiles;
      case Opcode::LoadTable:
        return tables;
      case Opcode::BeginFrame:
      case Opcode::EndFrame:
        break;
    }
    return frame;
  }
};

}  // namespace fastsplat::cmodel
