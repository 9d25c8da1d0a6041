// SPDX-License-Identifier: Apache-2.0
// Enlarges and moves the picture so that the non-empty voxels fill it.
#pragma once

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// scene.camera, enlarged and moved so that the footprints of all voxels with extinction just fit into the picture,
/// times `zoom`. Keeps the eye position. Returns the camera unchanged if the volume is empty.
Camera fitted_to_content(const Scene& scene, double zoom);

}  // namespace fastsplat::scene
