// SPDX-License-Identifier: Apache-2.0
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
/// A rectangle of P x P windows. Its first pixel lies `left`, `top` pixels from floor(centre) (N-4.6-3).
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
/// A splat with its own shape and its own windows, which the driver chooses (docs/numerics.md, section 4.6).
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
/// The same without the variant, for the driver's inner loop.
Beat to_beat(const SplatRecord& splat);
Beat to_beat(const EllipseRecord& ellipse);
SplatRecord to_splat(const Beat& beat);

/// The record of `beat`. Of load_table it is the header only: the words follow in later beats. The opcode must be known
/// (find_layout).
Record from_beat(const Beat& beat);

/// Number of words that load_table's header announces.
std::uint32_t announced_words(const Beat& load_table);
/// Number of beats that follow `header` in its record: load_table's words, else 0. To reach the next record, skip them.
std::uint64_t announced_beats(const Beat& header);

}  // namespace fastsplat::cmodel
