// SPDX-License-Identifier: Apache-2.0
#include "golden/splat/projection.hpp"

#include <cmath>

#include "scene/real_splat.hpp"

namespace fastsplat::golden {

Projector::Projector(const scene::Scene& scene)
    : scene_(scene),
      density_(cell_density(scene)),
      shape_(scene),
      textures_(scene.description.footprint.texture, scene.kernel) {}

ProjectedSplat Projector::operator()(const scene::Splat& splat) const {
  const scene::RealSplat real = scene::real_splat(scene_, splat);
  ProjectedSplat p{shape_(splat, real, scaled(real.material, density_))};
  p.x = real.at.x;
  p.y = real.at.y;
  p.z = real.depth;
  p.sheet = real.sheet;
  p.texture = textures_.phase_of(splat.position);
  p.texture_amplitude = textures_.amplitude();
  p.reach_x = scene_.kernel.radius() * std::sqrt(p.shape.xx);
  p.reach_y = scene_.kernel.radius() * std::sqrt(p.shape.yy);
  return p;
}

}  // namespace fastsplat::golden
