// The records of the stream as values, and their beats (docs/stream.md).
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "cmodel/stream_layout.hpp"

namespace fastsplat::cmodel {

struct BeginFrame {
  std::uint64_t config_hash = 0;
  int width = 0, height = 0;  ///< image, pixels
  std::uint32_t tiles = 0;
};
/// A radius set's place in the RLUT; zero for the other tables.
struct RadiusSet {
  std::uint32_t set = 0;
  std::uint32_t rho = 0;   ///< support radius, 1/K pixel
  std::uint32_t base = 0;  ///< first RLUT column
};
struct LoadTable {
  Table table = Table::Rlut;
  RadiusSet radius;
  std::vector<std::uint32_t> words;
};
struct BeginTile {
  Mode mode = Mode::Exponential;
  std::uint32_t tile = 0;
  std::int32_t x = 0, y = 0;
  int width = 0, height = 0;
};
struct BeginSheet {
  std::uint32_t sheet = 0;
};
struct SplatRecord {
  std::uint32_t set = 0;
  std::uint32_t tag = 0;
  std::int32_t x = 0, y = 0;              ///< S pi.pf, relative to the tile
  std::array<std::uint32_t, 4> colour{};  ///< R, G, B, tau; U 0.cf
};
struct CullBlock {
  std::uint32_t tag = 0;
  std::int32_t x = 0, y = 0;
  int width = 0, height = 0;
  std::uint32_t splats = 0;
};
struct EndSheet {
  std::uint32_t sheet = 0, splats = 0;
};
struct EndTile {
  std::uint32_t tile = 0, sheets = 0;
};
struct EndFrame {
  std::uint64_t beats = 0;
  std::uint32_t crc = 0;
};
using Record =
    std::variant<BeginFrame, LoadTable, BeginTile, BeginSheet, SplatRecord, CullBlock, EndSheet, EndTile, EndFrame>;

/// Appends the record's beats.
void append(std::vector<Beat>& beats, const Record& record);
/// The same without the variant: the driver's inner loop.
Beat to_beat(const SplatRecord& splat);
SplatRecord to_splat(const Beat& beat);

/// Every record but load_table, whose words follow in later beats: there only the header is filled.
/// The opcode must be known (find_layout).
Record from_beat(const Beat& beat);

/// Word count that load_table's header announces.
std::uint32_t announced_words(const Beat& load_table);
/// The beats that belong to a record behind its first, `header`: load_table's words. Whoever goes from record to record
/// passes over so many.
std::uint64_t announced_beats(const Beat& header);

}  // namespace fastsplat::cmodel
