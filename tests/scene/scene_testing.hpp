// SPDX-License-Identifier: Apache-2.0
// Shared by the tests of scene/: the helpers of scene/volume/'s tests under scene's name.
#pragma once

#include "tests/volume/volume_testing.hpp"

namespace fastsplat::scene {

using volume::make_volume;
using volume::refusal;
using volume::TemporaryFolder;

}  // namespace fastsplat::scene
