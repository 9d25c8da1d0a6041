// SPDX-License-Identifier: Apache-2.0
// Work that continues in the middle of a frame: registers that answer, interrupts that wait for the last pixel,
// counting from 0 after a reset.
#pragma once

#include <span>

#include "testbench/stimulus/frames.hpp"

namespace fastsplat::testbench {

/// Names of its bins in the group `refusal`.
std::span<const char* const> mid_frame_bins();

/// `frames`: a device of `make` that is at rest, without an error. `beats`: a whole legal stream with every record.
void check_mid_frame(const cmodel::Config& config, const MakeDevice& make, Frames& frames, const Beats& beats,
                     Check& check);

}  // namespace fastsplat::testbench
