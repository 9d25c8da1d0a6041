// SPDX-License-Identifier: Apache-2.0
// Frames for devices that cull, as opaque as possible: what is hidden is known from its place, whatever the first two
// words of RADIAL are.
#pragma once

#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stream_document.hpp"

namespace fastsplat::testbench {

/// A frame with these tiles, in order:
/// - cull groups beside the tile before its first splat and at a sheet's end, an empty group of the greatest height, an
///   opaque half and splats over it;
/// - the same without cull groups;
/// - a tile that ends while two of its tables are awaited.
StreamDocument sets_frame(const cmodel::Config& config, Random& random);

/// A tile of one row of pixels that is terminated as the tile ends. Behind it a tile in which those pixels are covered
/// once tests are made.
StreamDocument frozen_frame(const cmodel::Config& config, Random& random);

}  // namespace fastsplat::testbench
