#include "golden/splat/projection.hpp"

#include <cmath>

#include "golden/splat/antialias.hpp"
#include "golden/splat/perspective_footprint.hpp"
#include "scene/real_splat.hpp"

namespace fastsplat::golden {

Projector::Projector(const scene::Scene& scene)
    : scene_(scene),
      unit_(scene.volume->kernel_unit()),
      density_(cell_density(scene)),
      motion_(scene.description.motion, scene.camera, scene.kernel),
      lens_(scene.description.lens, scene.camera, scene.kernel),
      textures_(scene.description.footprint.texture, scene.kernel) {}

ProjectedSplat Projector::operator()(const scene::Splat& splat) const {
  const glm::dvec3 world(splat.position);
  const scene::RealSplat real = scene::real_splat(scene_, splat);
  const double pixels_per_unit = real.at.scale * unit_;
  const scene::FootprintSettings& footprint = scene_.description.footprint;

  ProjectedSplat p;
  p.x = real.at.x;
  p.y = real.at.y;
  p.z = real.depth;
  p.shape = {pixels_per_unit * pixels_per_unit, 0.0, pixels_per_unit * pixels_per_unit};
  p.value = scaled(real.material, density_);
  p.sheet = real.sheet;

  if (footprint.shape == scene::FootprintShape::Ellipse) apply_perspective(scene_.camera, world, real.at.depth, p);
  if (footprint.antialias) apply_antialias(pixels_per_unit, p);
  motion_.apply(world, p);
  lens_.apply(real.at.depth, p);

  p.texture = textures_.phase_of(splat.position);
  p.texture_amplitude = textures_.amplitude();

  p.reach_x = scene_.kernel.radius() * std::sqrt(p.shape.xx);
  p.reach_y = scene_.kernel.radius() * std::sqrt(p.shape.yy);
  return p;
}

}  // namespace fastsplat::golden
