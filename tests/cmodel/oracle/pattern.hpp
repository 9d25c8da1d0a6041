// SPDX-License-Identifier: Apache-2.0
// A solid pattern at a pixel of a sheet by docs/numerics.md, section 6.3: every number as an exact fraction, tables as
// they were loaded.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::oracle {

/// As they were loaded; empty in a frame without a pattern.
struct PatternTables {
  std::vector<std::uint32_t> nodes, pattern;
  bool loaded() const { return !nodes.empty(); }
};

/// t_R, t_G, t_B and b of a pixel of the image in a sheet.
struct Solid {
  std::array<Wide, 3> tint, lean;
};
Solid solid_at(const Symbols& c, const PatternTables& tables, Wide X, Wide Y, Wide sheet);

/// Words of table 8 or 9.
std::int64_t pattern_table_words(const Symbols& c, int table);
/// Whether the word is legal there.
bool pattern_word_fits(int table, std::size_t at, std::uint32_t word);

}  // namespace fastsplat::oracle
