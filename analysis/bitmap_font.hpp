// SPDX-License-Identifier: Apache-2.0
// Letters for legends: 5 x 7 dots, so that the program needs no font file.
#pragma once

#include <array>
#include <cstdint>

namespace fastsplat::analysis {

constexpr int kGlyphWidth = 5;
constexpr int kGlyphHeight = 7;
constexpr int kGlyphAdvance = kGlyphWidth + 1;

/// Rows from the top, bit 4 the leftmost dot. Characters without a glyph are blank.
using Glyph = std::array<std::uint8_t, kGlyphHeight>;
const Glyph& glyph(char character);

}  // namespace fastsplat::analysis
