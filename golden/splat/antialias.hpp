// Anti-aliased splatting (Swan et al. 1997, Mueller et al. 1998): from the depth on where voxels lie closer than pixels
// the kernel grows with depth. docs/techniques/anti-aliasing.md
#pragma once

#include <algorithm>
#include <cmath>

#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

/// lambda = max(1, z/k): at the crossover k a voxel is one pixel, beyond it the kernel keeps its size on the screen.
inline double kernel_growth(double pixels_per_unit) { return std::max(1.0, 1.0 / pixels_per_unit); }

/// h_l(x) = lambda^-3 h(x/lambda): footprint and depth extent grow by lambda; the footprint's amplitude falls as
/// lambda^-2, its slices' thickness makes up the third.
inline void apply_antialias(double pixels_per_unit, ProjectedSplat& splat) {
  const double growth = kernel_growth(pixels_per_unit);
  const double area = growth * growth;
  reshape(splat, {splat.shape.xx * area, splat.shape.xy * area, splat.shape.yy * area});
  splat.depth_growth = growth;
}

/// ProjectedSplat::depth_growth of a voxel `depth` mm behind the volume's centre.
inline double depth_growth(const scene::Scene& scene, double depth) {
  if (!scene.description.footprint.antialias) return 1.0;
  return kernel_growth(scene.camera.scale_at(depth) * scene.volume->kernel_unit());
}

/// The most that any splat of the scene grows: the farthest one.
inline double largest_growth(const scene::Scene& scene) { return depth_growth(scene, scene.volume->bounding_radius()); }

/// The most slabs that grown kernels may add: each one that a splat reaches is kept in memory.
inline constexpr double kMostSlabsMore = 4096;

/// scene::slab_grid with whole slabs added at both ends, so that the grown kernels of the nearest and the farthest
/// voxels find slabs as thin as all others. What was there keeps its place. UserError (Usage) when these are more than
/// kMostSlabsMore.
scene::SlabGrid slabs_for_grown_kernels(const scene::Scene& scene);

}  // namespace fastsplat::golden
