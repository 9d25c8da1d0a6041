// SPDX-License-Identifier: Apache-2.0
#include "cmodel/stream/records.hpp"

#include <cassert>

namespace fastsplat::cmodel {
namespace {

using namespace layout;

Beat begin(Opcode opcode) {
  Beat beat{};
  put(beat, kOpcode, static_cast<std::int64_t>(opcode));
  return beat;
}

struct ToBeat {
  Beat operator()(const BeginFrame& r) const {
    Beat beat = begin(Opcode::BeginFrame);
    put(beat, kFrameVersion, kStreamVersion);
    put(beat, kFrameMagic, kStreamMagic);
    put(beat, kFrameHashLow, static_cast<std::int64_t>(r.config_hash & 0xffffffffU));
    put(beat, kFrameHashHigh, static_cast<std::int64_t>(r.config_hash >> 32));
    put(beat, kFrameWidth, r.width);
    put(beat, kFrameHeight, r.height);
    put(beat, kFrameTiles, r.tiles);
    return beat;
  }
  Beat operator()(const LoadTable& r) const {
    Beat beat = begin(Opcode::LoadTable);
    put(beat, kTableId, static_cast<std::int64_t>(r.table));
    put(beat, kTableSet, r.radius.set);
    put(beat, kTableRho, r.radius.rho);
    put(beat, kTableWords, static_cast<std::int64_t>(r.words.size()));
    put(beat, kTableBase, r.radius.base);
    return beat;
  }
  Beat operator()(const BeginTile& r) const {
    Beat beat = begin(Opcode::BeginTile);
    put(beat, kTileMode, static_cast<std::int64_t>(r.mode));
    put(beat, kTileNumber, r.tile);
    put(beat, kTileX, r.x);
    put(beat, kTileY, r.y);
    put(beat, kTileWidth, r.width);
    put(beat, kTileHeight, r.height);
    return beat;
  }
  Beat operator()(const BeginSheet& r) const {
    Beat beat = begin(Opcode::BeginSheet);
    put(beat, kSheetNumber, r.sheet);
    return beat;
  }
  Beat operator()(const SplatRecord& r) const { return to_beat(r); }
  Beat operator()(const EllipseRecord& r) const { return to_beat(r); }
  Beat operator()(const CullBlock& r) const {
    Beat beat = begin(Opcode::CullBlock);
    put(beat, kCullTag, r.tag);
    put(beat, kCullX, r.x);
    put(beat, kCullY, r.y);
    put(beat, kCullWidth, r.width);
    put(beat, kCullHeight, r.height);
    put(beat, kCullSplats, r.splats);
    return beat;
  }
  Beat operator()(const EndSheet& r) const {
    Beat beat = begin(Opcode::EndSheet);
    put(beat, kEndSheetNumber, r.sheet);
    put(beat, kEndSheetSplats, r.splats);
    return beat;
  }
  Beat operator()(const EndTile& r) const {
    Beat beat = begin(Opcode::EndTile);
    put(beat, kEndTileNumber, r.tile);
    put(beat, kEndTileSheets, r.sheets);
    return beat;
  }
  Beat operator()(const EndFrame& r) const {
    Beat beat = begin(Opcode::EndFrame);
    put(beat, kEndFrameBeatsLow, static_cast<std::int64_t>(r.beats & 0xffffffffU));
    put(beat, kEndFrameBeatsHigh, static_cast<std::int64_t>(r.beats >> 32));
    put(beat, kEndFrameCrc, r.crc);
    return beat;
  }
};

std::uint32_t word(const Beat& beat, const Field& field) { return static_cast<std::uint32_t>(get(beat, field)); }
std::int32_t offset(const Beat& beat, const Field& field) { return static_cast<std::int32_t>(get(beat, field)); }
int count(const Beat& beat, const Field& field) { return static_cast<int>(get(beat, field)); }
std::uint64_t wide(const Beat& beat, const Field& low, const Field& high) {
  return static_cast<std::uint64_t>(word(beat, low)) | static_cast<std::uint64_t>(word(beat, high)) << 32;
}

}  // namespace

Beat to_beat(const SplatRecord& r) {
  Beat beat = begin(Opcode::Splat);
  put(beat, kSplatSet, r.set);
  put(beat, kSplatTag, r.tag);
  put(beat, kSplatX, r.x);
  put(beat, kSplatY, r.y);
  put(beat, kSplatR, r.colour[0]);
  put(beat, kSplatG, r.colour[1]);
  put(beat, kSplatB, r.colour[2]);
  put(beat, kSplatTau, r.colour[3]);
  return beat;
}

Beat to_beat(const EllipseRecord& r) {
  Beat beat = begin(Opcode::Ellipse);
  put(beat, kEllipseTag, r.tag);
  put(beat, kEllipseX, r.x);
  put(beat, kEllipseY, r.y);
  put(beat, kEllipseR, r.colour[0]);
  put(beat, kEllipseG, r.colour[1]);
  put(beat, kEllipseBlue, r.colour[2]);
  put(beat, kEllipseTau, r.colour[3]);
  put(beat, kEllipseA, r.shape.a);
  put(beat, kEllipseB, r.shape.b);
  put(beat, kEllipseC, r.shape.c);
  put(beat, kEllipseShift, r.shape.shift);
  put(beat, kEllipseLeft, r.windows.left);
  put(beat, kEllipseTop, r.windows.top);
  put(beat, kEllipseColumns, std::int64_t{r.windows.columns} - 1);
  put(beat, kEllipseRows, std::int64_t{r.windows.rows} - 1);
  return beat;
}

SplatRecord to_splat(const Beat& beat) {
  return {.set = word(beat, kSplatSet),
          .tag = word(beat, kSplatTag),
          .x = offset(beat, kSplatX),
          .y = offset(beat, kSplatY),
          .colour = {word(beat, kSplatR), word(beat, kSplatG), word(beat, kSplatB), word(beat, kSplatTau)}};
}

void append(std::vector<Beat>& beats, const Record& record) {
  beats.push_back(std::visit(ToBeat{}, record));
  const auto* table = std::get_if<LoadTable>(&record);
  if (table == nullptr) return;
  for (std::size_t first = 0; first < table->words.size(); first += kBeatWords) {
    Beat payload{};
    for (std::size_t i = 0; i < kBeatWords && first + i < table->words.size(); ++i)
      payload[i] = table->words[first + i];
    beats.push_back(payload);
  }
}

Record from_beat(const Beat& beat) {
  switch (static_cast<Opcode>(get(beat, kOpcode))) {
    case Opcode::BeginFrame:
      return BeginFrame{wide(beat, kFrameHashLow, kFrameHashHigh), count(beat, kFrameWidth), count(beat, kFrameHeight),
                        word(beat, kFrameTiles)};
    case Opcode::LoadTable:
      return LoadTable{static_cast<Table>(get(beat, kTableId)),
                       {word(beat, kTableSet), word(beat, kTableRho), word(beat, kTableBase)},
                       {}};
    case Opcode::BeginTile:
      return BeginTile{static_cast<Mode>(get(beat, kTileMode)),
                       word(beat, kTileNumber),
                       offset(beat, kTileX),
                       offset(beat, kTileY),
                       count(beat, kTileWidth),
                       count(beat, kTileHeight)};
    case Opcode::BeginSheet:
      return BeginSheet{word(beat, kSheetNumber)};
    case Opcode::Splat:
      return to_splat(beat);
    case Opcode::Ellipse:
      return EllipseRecord{
          .tag = word(beat, kEllipseTag),
          .x = offset(beat, kEllipseX),
          .y = offset(beat, kEllipseY),
          .colour = {word(beat, kEllipseR), word(beat, kEllipseG), word(beat, kEllipseBlue), word(beat, kEllipseTau)},
          .shape = {.a = word(beat, kEllipseA),
                    .c = word(beat, kEllipseC),
                    .b = offset(beat, kEllipseB),
                    .shift = word(beat, kEllipseShift)},
          .windows = {.left = offset(beat, kEllipseLeft),
                      .top = offset(beat, kEllipseTop),
                      .columns = word(beat, kEllipseColumns) + 1,
                      .rows = word(beat, kEllipseRows) + 1}};
    case Opcode::CullBlock:
      return CullBlock{word(beat, kCullTag),    offset(beat, kCullX),     offset(beat, kCullY),
                       count(beat, kCullWidth), count(beat, kCullHeight), word(beat, kCullSplats)};
    case Opcode::EndSheet:
      return EndSheet{word(beat, kEndSheetNumber), word(beat, kEndSheetSplats)};
    case Opcode::EndTile:
      return EndTile{word(beat, kEndTileNumber), word(beat, kEndTileSheets)};
    case Opcode::EndFrame:
      return EndFrame{wide(beat, kEndFrameBeatsLow, kEndFrameBeatsHigh), word(beat, kEndFrameCrc)};
  }
  assert(false && "opcode not checked");
  return EndFrame{};
}

std::uint32_t announced_words(const Beat& load_table) { return word(load_table, kTableWords); }
std::uint64_t announced_beats(const Beat& header) {
  if (get(header, kOpcode) != static_cast<std::int64_t>(Opcode::LoadTable)) return 0;
  return (std::uint64_t{announced_words(header)} + kBeatWords - 1) / kBeatWords;
}

}  // namespace fastsplat::cmodel
