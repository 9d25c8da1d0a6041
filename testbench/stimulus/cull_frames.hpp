// Frames for devices that cull, in which everything is as opaque as it can be: what is hidden is known by its place,
// whatever the first two words of RADIAL are.
#pragma once

#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stream_document.hpp"

namespace fastsplat::testbench {

/// Its tiles, in their order:
/// - sets beside the tile before its first splat and at a sheet's end, an empty set of the greatest height, an opaque
///   half and splats over it;
/// - the same without any set;
/// - one that ends while two of its tables are awaited.
StreamDocument sets_frame(const cmodel::Config& config, Random& random);

/// A tile of one row of pixels that is frozen as it ends, and one behind it in which those pixels are covered once
/// tests are made.
StreamDocument frozen_frame(const cmodel::Config& config, Random& random);

}  // namespace fastsplat::testbench
