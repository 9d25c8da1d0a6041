// SPDX-License-Identifier: Apache-2.0
// A small scene as the beats that a driver would send.
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"
#include "scene/scene.hpp"

namespace fastsplat::test {

/// The whole stream without end_frame.
std::vector<cmodel::Beat> scene_beats(const scene::SceneDescription& description, const cmodel::Config& config);

}  // namespace fastsplat::test
