// SPDX-License-Identifier: Apache-2.0
// The steps of projected 3-D Gaussians before their pixels: position, radius, emission. Each is a sample of its own, so
// there is neither depth nor share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/pipeline/splat_steps.hpp"
#include "driver/tables/quantise.hpp"
#include "scene/gaussians/projected_gaussian.hpp"

namespace fastsplat::stages {

class GaussianSteps {
 public:
  /// Projects them. Keeps a reference to `config`. UserError (Usage) if the device cannot draw them. What it clips at a
  /// record's reach is an error of step distance.
  GaussianSteps(const scene::GaussianScene& scene, const cmodel::Config& config, int threads);

  const scene::ProjectionReport& projection() const { return projection_; }
  /// Nearest first.
  const std::vector<scene::ProjectedGaussian>& gaussians() const { return gaussians_; }
  /// The number of one of them in its file.
  std::uint32_t number_of(std::size_t i) const { return cloud_->number_of(gaussians_[i].number); }
  /// With the numbers `which`. Values are alpha times colour, and alpha.
  Staged staged(std::span<const std::uint32_t> which, const Mixture& mixture, int threads, Staged memory) const;

 private:
  void stage(const scene::ProjectedGaussian& real, const Mixture& mixture, StagedSplat& splat,
             StagedShape& shape) const;

  const cmodel::Config& config_;
  std::shared_ptr<const scene::GaussianCloud> cloud_;
  driver::TileGrid grid_;
  driver::Target centre_, value_;
  double rim_;  ///< the cutoff's square
  scene::ProjectionReport projection_;
  std::vector<scene::ProjectedGaussian> gaussians_;
};

/// What a scene's picture needs behind these steps: a frame in which every sample is composited. It has no volume.
scene::Scene samples_scene(const scene::GaussianScene& scene);

}  // namespace fastsplat::stages
