// SPDX-License-Identifier: Apache-2.0
// How much anti-aliased kernels grow with depth (docs/techniques/anti-aliasing.md).
#pragma once

#include <algorithm>

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// lambda = max(1, z/k): at the crossover k a voxel is one pixel, beyond it the kernel keeps its size on the screen.
inline double kernel_growth(double pixels_per_unit) { return std::max(1.0, 1.0 / pixels_per_unit); }

/// Growth of a voxel `depth` mm behind the volume's centre; 1 without anti-aliasing.
inline double depth_growth(const Scene& scene, double depth) {
  if (!scene.description.footprint.antialias) return 1.0;
  return kernel_growth(scene.camera.scale_at(depth) * scene.volume->kernel_unit());
}

/// The largest growth in the scene, that of the farthest splat.
inline double largest_growth(const Scene& scene) { return depth_growth(scene, scene.volume->bounding_radius()); }

}  // namespace fastsplat::scene
