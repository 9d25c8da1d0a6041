// The picture enlarged and moved so that what is not empty fills it.
#pragma once

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// scene.camera, enlarged about where the footprints of all voxels with extinction lie, so that they just fit into the
/// picture, times `zoom`. The eye stays: a perspective does not change. As it is, where every voxel is empty.
Camera fitted_to_content(const Scene& scene, double zoom);

}  // namespace fastsplat::scene
