// SPDX-License-Identifier: Apache-2.0
#include "scene/splat_shaper.hpp"

#include "scene/antialias.hpp"
#include "scene/perspective_footprint.hpp"

namespace fastsplat::scene {

SplatShaper::SplatShaper(const Scene& scene)
    : scene_(scene),
      unit_(scene.volume->kernel_unit()),
      motion_(scene.description.motion, scene.camera, scene.kernel),
      lens_(scene.description.lens, scene.camera, scene.kernel) {}

ShapedSplat SplatShaper::operator()(const Splat& splat, const RealSplat& real,
                                    const std::array<double, 4>& value) const {
  const glm::dvec3 world(splat.position);
  const double pixels_per_unit = real.at.scale * unit_;
  const FootprintSettings& footprint = scene_.description.footprint;
  ShapedSplat out{.shape = {pixels_per_unit * pixels_per_unit, 0.0, pixels_per_unit * pixels_per_unit}, .value = value};
  if (footprint.shape == FootprintShape::Ellipse) apply_perspective(scene_.camera, world, real.at.depth, out);
  if (footprint.antialias) apply_antialias(pixels_per_unit, out);
  motion_.apply(world, out);
  lens_.apply(real.at.depth, out);
  return out;
}

}  // namespace fastsplat::scene
