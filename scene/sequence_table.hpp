// SPDX-License-Identifier: Apache-2.0
// The table [sequence] of scene.toml.
#pragma once

#include "scene/sequence.hpp"
#include "scene/toml_reader.hpp"

namespace fastsplat::scene {

/// Reads and checks all of `table`, and adds its tracks to `given`. A track is named as its setting is:
/// camera.azimuth = [0, 90].
Sequence read_sequence(TomlTable& table, std::vector<Given>& given);

}  // namespace fastsplat::scene
