// What one frame leaves behind in a device must not reach the next one: frames behind each other without a reset, whose
// tables look like records, and resets that follow each other.
#pragma once

#include <span>

#include "testbench/stimulus/frames.hpp"

namespace fastsplat::testbench {

/// Names in the group `refusal`.
std::span<const char* const> frame_after_frame_bins();

/// `frames`: a device that is at rest, without an error, and is left so. `beats`: a whole legal stream.
void check_frame_after_frame(const cmodel::Config& config, Frames& frames, const Beats& beats, Check& check);

}  // namespace fastsplat::testbench
