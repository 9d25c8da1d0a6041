// Voxel traversal: the non-empty voxels of a scene as classified, shaded splats, front to back.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// One voxel's kernel, pre-classified and pre-shaded.
struct Splat {
  glm::vec3 position;   ///< mm, world
  glm::vec3 emission;   ///< colour * extinction, per kernel unit, each <= extinction
  float extinction;     ///< per kernel unit, > 0
  std::uint16_t sheet;  ///< axis-aligned sheet number, 0 nearest to the eye
};

/// Visits every voxel with extinction > 0, slice by slice along the volume axis most parallel to the view direction,
/// nearest slice first; inside a slice by the remaining axes, also nearest first. The order is a function of the scene
/// only. For Method::XRay the order is the same (it does not matter there).
void for_each_splat(const Scene& scene, const std::function<void(const Splat&)>& visit);

std::vector<Splat> collect_splats(const Scene& scene);

/// Number of axis-aligned sheets (the grid's extent along the dominant axis).
int axis_sheet_count(const Scene& scene);

/// Image-aligned slabs: sheet s covers depth [first + s*width, first + (s+1)*width) in kernel units, relative to the
/// volume's centre. A slab boundary lies on the centre whatever the view, and the count depends only on the bounding
/// radius, the kernel and the width.
struct SlabGrid {
  double first = 0.0;  ///< depth of the nearest boundary, kernel units
  double width = 1.0;  ///< kernel units
  int count = 0;
};
SlabGrid slab_grid(const Scene& scene);

}  // namespace fastsplat::scene
