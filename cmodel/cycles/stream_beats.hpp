// SPDX-License-Identifier: Apache-2.0
// Beats that a source sends to a device, by kind of record (docs/stream.md).
#pragma once

#include <cstdint>

#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

// clang-format off
#define FASTSPLAT_BEAT_KINDS(X)                                \
  X(splats, "a record of one beat for each sheet and tile")    \
  X(hints, "cull_block")                                       \
  X(sheets, "begin_sheet and end_sheet")                       \
  X(tiles, "begin_tile and end_tile")                          \
  X(tables, "load_table and the words behind it")              \
  X(frame, "begin_frame and end_frame")
// clang-format on

struct StreamBeats {
#define X(name, meaning) std::uint64_t name = 0;
  FASTSPLAT_BEAT_KINDS(X)
#undef X

  /// Counts a beat; `payload`: words of a table.
  void count(Opcode opcode, bool payload) { ++of(payload ? Opcode::LoadTable : opcode); }
  std::uint64_t total() const {
    std::uint64_t sum = 0;
#define X(name, meaning) sum += name;
    FASTSPLAT_BEAT_KINDS(X)
#undef X
    return sum;
  }
  /// visit(name, beats, meaning) in the order above.
  template <class Visit>
  void for_each(Visit visit) const {
#define X(name, meaning) visit(#name, name, meaning);
    FASTSPLAT_BEAT_KINDS(X)
#undef X
  }

 private:
  std::uint64_t& of(Opcode opcode) {
    switch (opcode) {
      case Opcode::Splat:
      case Opcode::Ellipse:
        return splats;
      case Opcode::CullBlock:
        return hints;
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
