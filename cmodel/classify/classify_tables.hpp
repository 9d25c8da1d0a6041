// SPDX-License-Identifier: Apache-2.0
// Number and range of the words of density tables (docs/numerics.md, section 6.2; S-table-11).
#pragma once

#include <cstddef>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/index_set.hpp"
#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

namespace classify {

// Fraction bits of the words of section 6.2.
inline constexpr int kColour = 14;  ///< E, One
inline constexpr int kScale = 12;   ///< of differences, One
inline constexpr int kSlope = 16;   ///< g, S 4.16
inline constexpr int kTilt = 28;    ///< TX, DX, TY, DY, S 4.28
inline constexpr int kRoot = 14;    ///< 1/sqrt, One
inline constexpr int kLight = 14;   ///< light and half vector, S 2.14; their products with the normal, One
inline constexpr int kLength = 24;  ///< |g|, U 5.24
inline constexpr int kFloor = 8;    ///< 1/floor, U 24.8
inline constexpr int kShare = 8;    ///< of shading, One
inline constexpr int kPhong = 12;   ///< ambient, diffuse, specular, U 4.12; glint, One
inline constexpr int kLit = 16;     ///< shaded colour, One

inline constexpr int kRootBits = 5;   ///< log2 of ROOT's segments in a unit of m
inline constexpr int kGlintBits = 7;  ///< log2 of GLINT's segments

// Words of LIGHTING, in this order.
inline constexpr std::size_t kVectors = 0;  ///< light: right, down, ahead; half vector likewise
inline constexpr std::size_t kAmbient = 6, kDiffuse = 7, kSpecular = 8;
inline constexpr std::size_t kTilts = 9;  ///< TX, DX, TY, DY
inline constexpr std::size_t kLightWords = 13;
inline constexpr std::size_t kSheetWords = 2;  ///< words of SHEETS for each sheet: scales; 1/floor
inline constexpr int kSheetsBits = 12;         ///< SHEETS describes at most 2^this sheets

/// n(v, f, F) of section 6.2, which narrows all of its words (N-6.2-7).
inline Narrowing nearest(int from_frac, const Format& to) { return {Rounding::RND, Overflow::SAT, from_frac, to}; }

}  // namespace classify

/// Number of words of CLASSIFY, ROOT, GLINT or LIGHTING.
std::int64_t classify_words(const Config& config, Table table);
/// Range of word `word` of a table. Does not check the two scales in SHEETS' first word of a sheet.
WordRange classify_word_range(const Config& config, Table table, std::size_t word);

}  // namespace fastsplat::cmodel
