// SPDX-License-Identifier: Apache-2.0
// A pixel of a sheet of densities by docs/numerics.md, section 6.2: every number as an exact fraction, tables as they
// were loaded.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "tests/cmodel/oracle/pattern.hpp"
#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::oracle {

/// By load_table's number: 3 CLASSIFY, 4 ROOT, 5 GLINT, 6 LIGHTING, 7 SHEETS.
using DensityTables = std::map<int, std::vector<std::uint32_t>>;

/// Inputs of a pixel: its density, the differences of its neighbours as on the page, its place in the image.
struct DensityPixel {
  Wide density = 0, dx = 0, dy = 0, dz = 0;
  Wide X = 0, Y = 0;
  std::uint32_t sheet = 0;
};

/// Number of words of a table; 0: no such table, or as many as the frame has sheets.
std::int64_t density_table_words(const Symbols& c, int table);
/// Whether the word is legal there.
bool density_word_fits(const Symbols& c, int table, std::size_t at, std::uint32_t word);

/// S_R, S_G, S_B, S_tau of the pixel, with the frame's pattern if it has one.
std::array<Wide, 4> classify(const Symbols& c, const DensityTables& tables, const PatternTables& patterns,
                             const DensityPixel& pixel);

}  // namespace fastsplat::oracle
