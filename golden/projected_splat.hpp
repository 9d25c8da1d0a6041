// A splat as the image sees it: where its footprint lies, how large it is, what it adds.
#pragma once

#include <array>

#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

/// Sums that a sheet gathers per pixel: red, green, blue (premultiplied emission) and optical depth.
using Sums = std::array<double, 4>;

inline Sums scaled(const Sums& value, double share) {
  return {value[0] * share, value[1] * share, value[2] * share, value[3] * share};
}

struct ProjectedSplat {
  double x = 0.0, y = 0.0;       ///< pixels; pixel centres are at integers
  double z = 0.0;                ///< depth of the centre, kernel units
  double pixels_per_unit = 0.0;  ///< pixels per kernel unit at this depth
  double radius = 0.0;           ///< pixels; the footprint's support is strictly inside
  Sums value{};                  ///< times Kernel::footprint(): what the whole splat adds to a pixel
  int sheet = 0;                 ///< axis-aligned sheet
};

/// Kernel::footprint() integrates to the volume of one cubic cell; on an anisotropic grid a voxel stands for less.
inline double cell_density(const scene::Scene& scene) { return scene.amplitude / scene.kernel.peak(); }

inline ProjectedSplat project(const scene::Scene& scene, const scene::Splat& splat) {
  const double unit = scene.volume->kernel_unit();
  const double density = cell_density(scene);
  const scene::ScreenPoint at = scene.camera.project(glm::dvec3(splat.position));
  ProjectedSplat p;
  p.x = at.x;
  p.y = at.y;
  p.z = at.depth / unit;
  p.pixels_per_unit = at.scale * unit;
  p.radius = scene.kernel.radius() * p.pixels_per_unit;
  for (int c = 0; c < 3; ++c) p.value[c] = density * static_cast<double>(splat.emission[c]);
  p.value[3] = density * static_cast<double>(splat.extinction);
  p.sheet = splat.sheet;
  return p;
}

}  // namespace fastsplat::golden
