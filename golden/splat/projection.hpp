// SPDX-License-Identifier: Apache-2.0
// Projects a splat to its footprint on the screen.
#pragma once

#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"
#include "scene/splat_shaper.hpp"
#include "scene/splats.hpp"
#include "scene/textured_splats.hpp"

namespace fastsplat::golden {

/// Kernel::footprint() integrates to the volume of one cubic cell; a voxel of an anisotropic grid fills less.
inline double cell_density(const scene::Scene& scene) { return scene.amplitude / scene.kernel.peak(); }

class Projector {
 public:
  explicit Projector(const scene::Scene& scene);
  ProjectedSplat operator()(const scene::Splat& splat) const;

 private:
  const scene::Scene& scene_;
  double density_;
  scene::SplatShaper shape_;
  scene::TexturedSplats textures_;
};

}  // namespace fastsplat::golden
