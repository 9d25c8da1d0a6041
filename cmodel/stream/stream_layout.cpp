// SPDX-License-Identifier: Apache-2.0
#include "cmodel/stream/stream_layout.hpp"

#include <array>

namespace fastsplat::cmodel {
namespace {

using namespace layout;

constexpr std::array kBeginFrame{NamedField{"version", kFrameVersion},  NamedField{"magic", kFrameMagic},
                                 NamedField{"hash_low", kFrameHashLow}, NamedField{"hash_high", kFrameHashHigh},
                                 NamedField{"width", kFrameWidth},      NamedField{"height", kFrameHeight},
                                 NamedField{"tiles", kFrameTiles}};
constexpr std::array kLoadTable{NamedField{"table", kTableId}, NamedField{"set", kTableSet},
                                NamedField{"rho", kTableRho}, NamedField{"words", kTableWords},
                                NamedField{"base", kTableBase}};
constexpr std::array kBeginTile{NamedField{"mode", kTileMode},   NamedField{"tile", kTileNumber},
                                NamedField{"x", kTileX},         NamedField{"y", kTileY},
                                NamedField{"width", kTileWidth}, NamedField{"height", kTileHeight}};
constexpr std::array kBeginSheet{NamedField{"sheet", kSheetNumber}};
constexpr std::array kSplat{NamedField{"set", kSplatSet}, NamedField{"tag", kSplatTag}, NamedField{"x", kSplatX},
                            NamedField{"y", kSplatY},     NamedField{"r", kSplatR},     NamedField{"g", kSplatG},
                            NamedField{"b", kSplatB},     NamedField{"tau", kSplatTau}};
constexpr std::array kEllipse{
    NamedField{"b_term", kEllipseB},        NamedField{"tag", kEllipseTag},   NamedField{"x", kEllipseX},
    NamedField{"columns", kEllipseColumns}, NamedField{"rows", kEllipseRows}, NamedField{"y", kEllipseY},
    NamedField{"h", kEllipseShift},         NamedField{"r", kEllipseR},       NamedField{"g", kEllipseG},
    NamedField{"b", kEllipseBlue},          NamedField{"tau", kEllipseTau},   NamedField{"a_term", kEllipseA},
    NamedField{"left", kEllipseLeft},       NamedField{"c_term", kEllipseC},  NamedField{"top", kEllipseTop}};
constexpr std::array kCullBlock{NamedField{"tag", kCullTag},       NamedField{"x", kCullX},
                                NamedField{"y", kCullY},           NamedField{"width", kCullWidth},
                                NamedField{"height", kCullHeight}, NamedField{"splats", kCullSplats}};
constexpr std::array kEndSheet{NamedField{"sheet", kEndSheetNumber}, NamedField{"splats", kEndSheetSplats}};
constexpr std::array kEndTile{NamedField{"tile", kEndTileNumber}, NamedField{"sheets", kEndTileSheets}};
constexpr std::array kEndFrame{NamedField{"beats_low", kEndFrameBeatsLow}, NamedField{"beats_high", kEndFrameBeatsHigh},
                               NamedField{"crc", kEndFrameCrc}};

constexpr std::array kRecords{
    RecordLayout{Opcode::BeginFrame, "begin_frame", kBeginFrame},
    RecordLayout{Opcode::LoadTable, "load_table", kLoadTable},
    RecordLayout{Opcode::BeginTile, "begin_tile", kBeginTile},
    RecordLayout{Opcode::BeginSheet, "begin_sheet", kBeginSheet},
    RecordLayout{Opcode::Splat, "splat", kSplat},
    RecordLayout{Opcode::Ellipse, "ellipse", kEllipse},
    RecordLayout{Opcode::CullBlock, "cull_block", kCullBlock},
    RecordLayout{Opcode::EndSheet, "end_sheet", kEndSheet},
    RecordLayout{Opcode::EndTile, "end_tile", kEndTile},
    RecordLayout{Opcode::EndFrame, "end_frame", kEndFrame},
};

}  // namespace

std::span<const RecordLayout> record_layouts() { return kRecords; }

Beat used_bits(const RecordLayout& record) {
  Beat used{};
  used[0] = field_mask(kOpcode);
  for (const auto& named : record.fields) used[static_cast<std::size_t>(named.field.word)] |= field_mask(named.field);
  return used;
}

const RecordLayout* find_layout(std::uint32_t opcode) {
  for (const auto& record : kRecords) {
    if (static_cast<std::uint32_t>(record.opcode) == opcode) return &record;
  }
  return nullptr;
}

}  // namespace fastsplat::cmodel
