// SPDX-License-Identifier: Apache-2.0
// What the tests of scene/ share: the helpers of scene/volume/'s tests under scene's name.
#pragma once

#include "tests/volume/volume_testing.hpp"

namespace fastsplat::scene {

using volume::make_volume;
using volume::refusal;
using volume::TemporaryFolder;

}  // namespace fastsplat::scene
