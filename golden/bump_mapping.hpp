// SPDX-License-Identifier: Apache-2.0
// Bump mapping per pixel (Blinn 1978) on a solid pattern; docs/techniques/bump-mapping.md. The normal leans with the
// pattern's slope along the surface,
//     n' = normalize(n + amplitude (grad B - (grad B . n) n)),   B(x) = pattern(x / scale), grad by x / scale.
#pragma once

#include "golden/pixel_stage.hpp"
#include "scene/solid_texture.hpp"

namespace fastsplat::golden {

/// The tilt scales with the gradient's length, so weak gradients stay weak for the shader. Amplitude 0 changes no bit.
class BumpMapping final : public PixelStage {
 public:
  explicit BumpMapping(const scene::Bump& bump) : bump_(bump) {}
  void apply(PixelSample& sample) const override {
    const double length = glm::length(sample.gradient);
    if (!(length > 0.0)) return;
    const glm::dvec3 normal = sample.gradient / length;
    const glm::dvec3 slope = scene::solid_gradient(bump_.kind, sample.position / bump_.scale);
    sample.gradient += bump_.amplitude * length * (slope - glm::dot(slope, normal) * normal);
  }

 private:
  scene::Bump bump_;
};

}  // namespace fastsplat::golden
