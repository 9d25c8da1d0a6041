// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, as .glb or .gltf, with primitives of KHR_gaussian_splatting.
#pragma once

#include <string>
#include <string_view>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

bool is_gltf(std::string_view head);

/// Fills `to`, whose source names the file, with all such primitives of the scene. Positions, rotations and uniform
/// scales of nodes are applied. UserError (Input) for other transformations, for compressed data, and for a file
/// without such primitives.
void read_gltf(const std::string& bytes, GaussianCloud& to);

/// A .glb of floats with the kernel `ellipse`. Viewers without the extension show COLOR_0 as points.
std::string glb_bytes(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
