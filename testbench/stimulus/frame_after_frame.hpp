// SPDX-License-Identifier: Apache-2.0
// One frame must not leave anything in a device for the next: frames in sequence without a reset, whose tables look
// like records, and resets in sequence.
#pragma once

#include <span>

#include "testbench/stimulus/frames.hpp"

namespace fastsplat::testbench {

/// Names of its bins in the group `refusal`.
std::span<const char* const> frame_after_frame_bins();

/// `frames`: a device that is at rest, without an error, and is left so. `beats`: a whole legal stream.
void check_frame_after_frame(const cmodel::Config& config, Frames& frames, const Beats& beats, Check& check);

}  // namespace fastsplat::testbench
