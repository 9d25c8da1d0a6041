// SPDX-License-Identifier: Apache-2.0
// Number and range of the words of a solid pattern's tables (docs/numerics.md, section 6.3; S-table-13).
#pragma once

#include <cstddef>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/index_set.hpp"
#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

namespace pattern {

// Fraction bits of the words of section 6.3.
inline constexpr int kValue = 16;   ///< v, U 0
inline constexpr int kLean = 15;    ///< B, S 1
inline constexpr int kAmount = 16;  ///< A, U 10; b = B A, S 10
inline constexpr int kStep = 24;    ///< nodes a pixel or sheet, U 8
inline constexpr int kPlace = 12;   ///< a place among the nodes
inline constexpr int kTint = 16;    ///< lo, hi, t, One

inline constexpr int kAmountInt = 10;
inline constexpr int kLeantInt = 14;          ///< g', S 14.16
inline constexpr std::int64_t kFar = 0xFFFF;  ///< largest distance from X0, Y0, Z0, in pixels or sheets
inline constexpr std::size_t kNodeWords = 2;  ///< v and B_x; B_y and B_z
inline constexpr std::size_t kPlaces = 0;     ///< words of PATTERN: X0, Y0, Z0
inline constexpr std::size_t kSteps = 3;      ///< DX, DY, DZ
inline constexpr std::size_t kLow = 6;        ///< R, G, B
inline constexpr std::size_t kHigh = 9;       ///< R, G, B
inline constexpr std::size_t kA = 12;         ///< A
inline constexpr std::size_t kPatternWords = 13;

}  // namespace pattern

/// Number of words of NODES or PATTERN.
std::int64_t pattern_words(const Config& config, Table table);
/// Range of word `word` of NODES or PATTERN.
WordRange pattern_word_range(Table table, std::size_t word);

}  // namespace fastsplat::cmodel
