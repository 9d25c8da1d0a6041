// The records of the stream as values, and their beats (docs/stream.md).
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "cmodel/stream/stream_layout.hpp"

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
/// q = (A dx^2 + B dx dy + C dy^2) 2^-h, in steps of 2^-g radial table entries; dx, dy in 2^-pf pixel.
struct EllipseShape {
  std::uint32_t a = 0, c = 0;  ///< 22 bits
  std::int32_t b = 0;          ///< 24 bits, two's complement
  std::uint32_t shift = 0;     ///< h, 0..63
};
/// P x P windows, row by row: the first pixel relative to the pixel that the centre lies in or right and below of.
struct EllipseWindows {
  std::int32_t left = 0, top = 0;       ///< -512..511 pixels
  std::uint32_t columns = 1, rows = 1;  ///< 1..32
};
struct SplatRecord {
  std::uint32_t set = 0;
  std::uint32_t tag = 0;
  std::int32_t x = 0, y = 0;              ///< S pi.pf, relative to the tile
  std::array<std::uint32_t, 4> colour{};  ///< R, G, B, tau; U 0.cf
};
/// A splat with a shape of its own (docs/numerics.md, section 4.6), its window rectangle where the driver wants it.
struct EllipseRecord {
  std::uint32_t tag = 0;
  std::int32_t x = 0, y = 0;              ///< S pi.pf, relative to the tile
  std::array<std::uint32_t, 4> colour{};  ///< R, G, B, tau; U 0.cf
  EllipseShape shape;
  EllipseWindows windows;
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
using Record = std::variant<BeginFrame, LoadTable, BeginTile, BeginSheet, SplatRecord, EllipseRecord, CullBlock,
                            EndSheet, EndTile, EndFrame>;

/// Appends the record's beats.
void append(std::vector<Beat>& beats, const Record& record);
/// The same without the variant: the driver's inner loop.
Beat to_beat(const SplatRecord& splat);
Beat to_beat(const EllipseRecord& ellipse);
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
