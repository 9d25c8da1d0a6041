// SPDX-License-Identifier: Apache-2.0
// The rules of docs/stream.md by number: why StreamDecode refuses a beat, and what the device's register ERROR shows.
#pragma once

#include <cstdint>
#include <utility>

#include "base/error.hpp"

namespace fastsplat::cmodel {

// X(name, number, register name, meaning), in the order in which a record is checked. A device checks all but the last
// three (S-reader-4).
#define FASTSPLAT_STREAM_RULES(X)                                                                              \
  X(None, 0, NONE, "nothing was refused")                                                                      \
  X(Opcode, 1, OPCODE, "the opcode is a record's")                                                             \
  X(Order, 2, ORDER, "the grammar: the record is allowed here")                                                \
  X(Reserved, 3, RESERVED, "unnamed bits and words are 0")                                                     \
  X(Format, 4, FORMAT, "begin_frame: magic and version")                                                       \
  X(Configuration, 5, CONFIGURATION, "begin_frame: the hash is the device's")                                  \
  X(Image, 6, IMAGE, "begin_frame: image sides are at least 1")                                                \
  X(Table, 7, TABLE, "load_table: table, set, rho, base and number of words")                                  \
  X(Words, 8, WORDS, "table words: range, never increasing in FACTOR, padding 0")                              \
  X(Loaded, 9, LOADED, "begin_tile: RADIAL and FACTOR were loaded since begin_frame")                          \
  X(Tile, 10, TILE, "begin_tile: mode, number below the count, sides, inside the image")                       \
  X(Sheet, 11, SHEET, "begin_sheet: numbers rise within the tile")                                             \
  X(Set, 12, SET, "splat: its radius set was loaded since begin_frame")                                        \
  X(Range, 13, RANGE, "splat, ellipse: x, y and colours fit their formats")                                    \
  X(Tag, 14, TAG, "splat, ellipse: tags count 0, 1, 2, ... within the tile")                                   \
  X(Cull, 15, CULL, "cull_block: width and height are at least 1")                                             \
  X(EndNumber, 16, END_NUMBER, "end_sheet, end_tile: the number of the sheet or tile")                         \
  X(EndCount, 17, END_COUNT, "end_sheet, end_tile: the count of splats or sheets")                             \
  X(Shape, 18, SHAPE,                                                                                          \
    "ellipse: 4 A C is at least B^2, its windows' far side within reach, q in range at their corners")         \
  X(Promise, 19, PROMISE,                                                                                      \
    "cull_block, unless cull.map is off: tag, windows within its rectangle, all its splats before end_sheet, " \
    "limits of open cull_blocks and splats")                                                                   \
  X(Whole, 255, WHOLE,                                                                                         \
    "a whole stream: tile numbers 0, 1, 2, ..., all tiles, the number of beats, the checksum, nothing missing")

enum class StreamRule : std::uint8_t {
#define X(name, number, register_name, meaning) name = number,
  FASTSPLAT_STREAM_RULES(X)
#undef X
};

/// Whether a device checks the rule, too. Only a reader checks the others; writers of streams have to keep them.
constexpr bool checked_by_device(StreamRule rule) {
  return rule != StreamRule::Shape && rule != StreamRule::Promise && rule != StreamRule::Whole;
}

/// Thrown for a beat that breaks a rule.
class StreamRefusal : public UserError {
 public:
  StreamRefusal(StreamRule rule, std::uint64_t beat, ErrorParts parts)
      : UserError(ExitCode::Input, std::move(parts)), rule_(rule), beat_(beat) {}
  StreamRule rule() const { return rule_; }
  std::uint64_t beat() const { return beat_; }  ///< begin_frame is beat 0

 private:
  StreamRule rule_;
  std::uint64_t beat_;
};

}  // namespace fastsplat::cmodel
