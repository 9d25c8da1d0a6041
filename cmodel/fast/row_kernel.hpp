// SPDX-License-Identifier: Apache-2.0
// Adds whole footprints to a sheet with vector instructions, chosen for the processor at run time (Highway).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "cmodel/fast/fast_plan.hpp"

namespace fastsplat::cmodel::fast {

/// Words of a row of a footprint's weights, a multiple of 8.
constexpr std::uint32_t pitch_of(std::uint32_t columns) { return (columns + 7) / 8 * 8; }

/// One footprint to add: `rows` rows of pitch_of(columns) weights, 0 after the columns. All of them must fit the
/// memory.
struct SplatJob {
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;                   ///< index of the first pixel in the sheet or picture
  std::uint16_t columns = 0, rows = 0;    ///< pixels that may have a weight
  std::array<std::uint16_t, 4> colour{};  ///< shifted left by plan.colour_shift
};

/// Adds the footprints to a sheet of interleaved words of 16 bits (saturating) or 32 bits (modulo 2^32). Pixel i holds
/// words 4i..4i+3; rows are `row` pixels apart. False if the plan checks for carries and there was one.
bool add_splats(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint16_t* sheet, std::size_t row);
bool add_splats(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint32_t* sheet, std::size_t row);

/// The share of a hidden splat in one sheet; word 0: no share.
struct HiddenShare {
  std::uint32_t word = 0;    ///< the largest of R, G, B and tau
  std::uint32_t excess = 0;  ///< how much that exceeds tau
};

/// A hidden footprint, with members as in SplatJob.
struct HiddenJob {
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;
  std::uint16_t columns = 0, rows = 0;
};

/// Upper bounds of sums, a word a pixel, laid out like the sheet (FastPlan::hides). Plane `first` is that of the
/// current sheet; those of the following sheets come next, cyclically.
struct Planes {
  std::uint16_t* words;
  std::size_t pixels, row, count, first;
};

/// Adds at least its word times the footprint to the plane of each share. A saturated word bounds nothing any more.
void add_hidden(const FastPlan& plan, const HiddenJob& job, std::span<const HiddenShare> shares, const Planes& planes);

/// Whether this processor has the required vector instructions; otherwise use the plain unit.
bool has_vectors();
/// Name of the instruction set of add_splats, such as "AVX2"; null without one.
const char* vector_target();

}  // namespace fastsplat::cmodel::fast
