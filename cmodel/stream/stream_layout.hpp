// SPDX-License-Identifier: Apache-2.0
// The place of every field of every record: the source of encoders, decoders and the RTL's package. A test compares
// docs/stream.md with it.
#pragma once

#include <cstdint>
#include <span>

#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel {

enum class Opcode : std::uint8_t {
  BeginFrame = 0x46,
  LoadTable = 0x4C,
  BeginTile = 0x54,
  BeginSheet = 0x53,
  Splat = 0x50,
  Ellipse = 0x45,
  CullBlock = 0x43,
  EndSheet = 0x73,
  EndTile = 0x74,
  EndFrame = 0x66,
};

/// Classify to Sheets: only devices that classify densities. Nodes and Pattern: only devices with solid patterns.
enum class Table : std::uint8_t {
  Rlut = 0,
  Radial = 1,
  Factor = 2,
  Classify = 3,
  Root = 4,
  Glint = 5,
  Lighting = 6,
  Sheets = 7,
  Nodes = 8,
  Pattern = 9
};
/// How a tile composites: the sums of sheets, the products of every window (bit 2), or sums that are densities (bit 3).
enum class Mode : std::uint8_t {
  Exponential = 0,
  Additive = 1,
  Sum = 2,
  SampleExponential = 4,
  SampleAdditive = 5,
  DensityExponential = 8,
  DensityAdditive = 9
};
constexpr bool every_sample(Mode mode) { return mode == Mode::SampleExponential || mode == Mode::SampleAdditive; }
constexpr bool holds_densities(Mode mode) { return mode == Mode::DensityExponential || mode == Mode::DensityAdditive; }
/// Exponential, Additive or Sum.
constexpr Mode slab_mode(Mode mode) { return static_cast<Mode>(static_cast<unsigned>(mode) & 3U); }

constexpr std::uint32_t kStreamMagic = 0x31535346;  // "FSS1"
constexpr int kStreamVersion = 2;

namespace layout {
inline constexpr Field kOpcode{0, 0, 8};

inline constexpr Field kFrameVersion{0, 16, 16}, kFrameMagic{1, 0, 32}, kFrameHashLow{2, 0, 32},
    kFrameHashHigh{3, 0, 32}, kFrameWidth{4, 0, 16}, kFrameHeight{4, 16, 16}, kFrameTiles{5, 0, 32};
inline constexpr Field kTableId{0, 8, 8}, kTableSet{1, 0, 32}, kTableRho{2, 0, 32}, kTableWords{3, 0, 32},
    kTableBase{4, 0, 32};
inline constexpr Field kTileMode{0, 8, 4}, kTileNumber{1, 0, 32}, kTileX{2, 0, 32, true}, kTileY{3, 0, 32, true},
    kTileWidth{4, 0, 16}, kTileHeight{4, 16, 16};
inline constexpr Field kSheetNumber{1, 0, 32};
inline constexpr Field kSplatSet{0, 8, 8}, kSplatTag{1, 0, 32}, kSplatX{2, 0, 32, true}, kSplatY{3, 0, 32, true},
    kSplatR{4, 0, 16}, kSplatG{4, 16, 16}, kSplatB{5, 0, 16}, kSplatTau{5, 16, 16};
// One beat holds position, colour, windows and shape.
inline constexpr Field kEllipseB{0, 8, 24, true}, kEllipseTag{1, 0, 32}, kEllipseX{2, 0, 22, true},
    kEllipseColumns{2, 22, 5}, kEllipseRows{2, 27, 5}, kEllipseY{3, 0, 22, true}, kEllipseShift{3, 22, 6},
    kEllipseR{4, 0, 16}, kEllipseG{4, 16, 16}, kEllipseBlue{5, 0, 16}, kEllipseTau{5, 16, 16}, kEllipseA{6, 0, 22},
    kEllipseLeft{6, 22, 10, true}, kEllipseC{7, 0, 22}, kEllipseTop{7, 22, 10, true};
inline constexpr Field kCullTag{1, 0, 32}, kCullX{2, 0, 32, true}, kCullY{3, 0, 32, true}, kCullWidth{4, 0, 16},
    kCullHeight{4, 16, 16}, kCullSplats{5, 0, 32};
inline constexpr Field kEndSheetNumber{1, 0, 32}, kEndSheetSplats{2, 0, 32};
inline constexpr Field kEndTileNumber{1, 0, 32}, kEndTileSheets{2, 0, 32};
inline constexpr Field kEndFrameBeatsLow{1, 0, 32}, kEndFrameBeatsHigh{2, 0, 32}, kEndFrameCrc{3, 0, 32};
}  // namespace layout

struct NamedField {
  const char* name;
  Field field;
};

struct RecordLayout {
  Opcode opcode;
  const char* name;
  std::span<const NamedField> fields;  ///< without the opcode
};

/// All records, in the order of docs/stream.md.
std::span<const RecordLayout> record_layouts();
/// Mask of the record's bits that have a name; the others must be 0 (S-record-3).
Beat used_bits(const RecordLayout& record);
/// nullptr for an unknown opcode.
const RecordLayout* find_layout(std::uint32_t opcode);

}  // namespace fastsplat::cmodel
