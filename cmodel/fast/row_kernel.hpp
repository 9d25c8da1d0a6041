// Adding whole footprints into a sheet with vector instructions, chosen for the processor at run time (Highway).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/fast/fast_plan.hpp"

namespace fastsplat::cmodel::fast {

/// What the footprints of one radius set have in common, pixels.
struct JobShape {
  std::uint32_t extent = 0;  ///< rows, and pixels of a row, that may have a weight
  std::uint32_t pitch = 0;   ///< weights from row to row, a multiple of 8
};

/// One footprint to add. The sheet has room for `pitch` pixels in each row, weighted or not.
struct SplatJob {
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;  ///< first pixel, of the sheet's memory
  std::uint32_t set = 0;
  std::array<std::uint16_t, 4> colour{};  ///< shifted left by plan.colour_shift
};

/// What the kernels need to know of a frame.
struct JobFrame {
  FastPlan plan;
  std::vector<JobShape> shapes;  ///< per radius set
};

/// Adds the footprints to a sheet of interleaved words of 16 bits (saturating) or 32 bits (modulo 2^32): pixel i holds
/// words 4i..4i+3, `row` pixels lie from one row to the next. False if the plan looks for carries and there was one.
bool add_splats(const JobFrame& frame, std::span<const SplatJob> jobs, std::uint16_t* sheet, std::size_t row);
bool add_splats(const JobFrame& frame, std::span<const SplatJob> jobs, std::uint32_t* sheet, std::size_t row);

/// What of a splat falls into one sheet, for a splat that cannot be seen. No word: nothing falls there.
struct HiddenShare {
  std::uint32_t word = 0;    ///< the largest of R, G, B and tau
  std::uint32_t excess = 0;  ///< what that is above tau
};

/// A footprint that cannot be seen, with its shares of several sheets.
struct HiddenJob {
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0, set = 0;  ///< as of SplatJob
};

/// Bounds of sums, a word a pixel, laid out as the sheet (FastPlan::hides): a plane for the sheet at hand, `first`, and
/// one for each that follows, coming round behind the last.
struct Planes {
  std::uint16_t* words;
  std::size_t pixels, row, count, first;
};

/// Adds to each share's plane at least its word times the footprint; a word at its end says nothing any more.
void add_hidden(const JobFrame& frame, const HiddenJob& job, std::span<const HiddenShare> shares, const Planes& planes);

/// Whether this processor has vector instructions for it; without them the plain unit is meant.
bool has_vectors();
/// "AVX2" and the like: what add_splats runs on.
const char* vector_target();

}  // namespace fastsplat::cmodel::fast
