// Adding whole footprints into a sheet with vector instructions, chosen for the processor at run time (Highway).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "cmodel/fast/fast_plan.hpp"

namespace fastsplat::cmodel::fast {

/// Weights from row to row of a footprint, a multiple of 8.
constexpr std::uint32_t pitch_of(std::uint32_t columns) { return (columns + 7) / 8 * 8; }

/// One footprint to add: `rows` rows of pitch_of(columns) weights, 0 behind the columns. The picture has room for them.
struct SplatJob {
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;                   ///< first pixel, of the picture's memory
  std::uint16_t columns = 0, rows = 0;    ///< pixels that may have a weight
  std::array<std::uint16_t, 4> colour{};  ///< shifted left by plan.colour_shift
};

/// Adds the footprints to a sheet of interleaved words of 16 bits (saturating) or 32 bits (modulo 2^32): pixel i holds
/// words 4i..4i+3, `row` pixels lie from one row to the next. False if the plan looks for carries and there was one.
bool add_splats(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint16_t* sheet, std::size_t row);
bool add_splats(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint32_t* sheet, std::size_t row);

/// What of a splat falls into one sheet, for a splat that cannot be seen. No word: nothing falls there.
struct HiddenShare {
  std::uint32_t word = 0;    ///< the largest of R, G, B and tau
  std::uint32_t excess = 0;  ///< what that is above tau
};

/// A footprint that cannot be seen, as of SplatJob, with its shares of several sheets.
struct HiddenJob {
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;
  std::uint16_t columns = 0, rows = 0;
};

/// Bounds of sums, a word a pixel, laid out as the sheet (FastPlan::hides): a plane for the sheet at hand, `first`, and
/// one for each that follows, coming round behind the last.
struct Planes {
  std::uint16_t* words;
  std::size_t pixels, row, count, first;
};

/// Adds to each share's plane at least its word times the footprint; a word at its end says nothing any more.
void add_hidden(const FastPlan& plan, const HiddenJob& job, std::span<const HiddenShare> shares, const Planes& planes);

/// Whether this processor has vector instructions for it; without them the plain unit is meant.
bool has_vectors();
/// "AVX2" and the like: what add_splats runs on.
const char* vector_target();

}  // namespace fastsplat::cmodel::fast
