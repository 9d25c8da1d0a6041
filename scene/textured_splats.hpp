// SPDX-License-Identifier: Apache-2.0
// Textured splats (Crawfis, Max 1993): a footprint with detail of its own, one of N phases that are cycled over frames.
// docs/techniques/textured-splats.md
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/kernel.hpp"
#include "scene/techniques.hpp"

namespace fastsplat::scene {

/// One phase: t(u,v) in [-1,1] on the square |u|,|v| <= R around a splat's centre, kernel units, sampled on a grid and
/// bilinear between.
class TexturePhase {
 public:
  TexturePhase(int side, double radius, std::vector<double> samples)
      : side_(side), radius_(radius), samples_(std::move(samples)) {}
  double operator()(double u, double v) const;
  int side() const { return side_; }  ///< samples along u and along v, the first at -R and the last at R

 private:
  int side_;
  double radius_;
  std::vector<double> samples_;
};

class TexturedSplats {
 public:
  /// Makes no phases if the amplitude is 0. The phases depend only on the settings and the kernel's shape.
  ///     sum over all phases of t_i(u,v) = 0 at every place,
  ///     integral of F(rho) t_i = 0 for every phase, F the kernel's footprint.
  TexturedSplats(const SplatTexture& settings, const Kernel& kernel);

  /// The current phase of a splat: (hash of its place + frame) mod N. 0, or null, when off.
  std::size_t number_of(const glm::vec3& position) const;
  const TexturePhase* phase_of(const glm::vec3& position) const {
    return phases_.empty() ? nullptr : &phases_[number_of(position)];
  }
  /// m in F'(x,y) = F(rho) (1 + m t_i(x,y)).
  double amplitude() const { return amplitude_; }
  const std::vector<TexturePhase>& phases() const { return phases_; }

 private:
  double amplitude_;
  unsigned frame_;
  std::vector<TexturePhase> phases_;
};

}  // namespace fastsplat::scene
