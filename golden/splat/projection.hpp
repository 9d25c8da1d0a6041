// From a splat to its footprint on the screen: one pipeline in which every technique changes the shape that the one
// before it left.
//
//   circle -> ellipse (perspective) -> growth (anti-aliasing) -> + motion -> + lens
//
// Each is absent unless its setting asks for it, and leaves every bit alone where it has nothing to do.
#pragma once

#include "golden/splat/depth_of_field_splats.hpp"
#include "golden/splat/motion_blur.hpp"
#include "golden/splat/projected_splat.hpp"
#include "golden/splat/textured_splats.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

/// Kernel::footprint() integrates to the volume of one cubic cell; on an anisotropic grid a voxel stands for less.
inline double cell_density(const scene::Scene& scene) { return scene.amplitude / scene.kernel.peak(); }

class Projector {
 public:
  explicit Projector(const scene::Scene& scene);
  ProjectedSplat operator()(const scene::Splat& splat) const;

 private:
  const scene::Scene& scene_;
  double unit_, density_;
  MotionBlur motion_;
  DepthOfFieldSplats lens_;
  TexturedSplats textures_;
};

}  // namespace fastsplat::golden
