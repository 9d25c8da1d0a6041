// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/gaussian_steps.hpp"

#include <cmath>

#include "base/parallel/parallel.hpp"
#include "driver/tiles/gaussian_frame.hpp"

namespace fastsplat::stages {

GaussianSteps::GaussianSteps(const scene::GaussianScene& scene, const cmodel::Config& config, int threads)
    : config_(config),
      cloud_(scene.cloud),
      grid_(config, scene.camera.width(), scene.camera.height()),
      centre_(driver::target(driver::Site::EllipseCentre, config)),
      value_(driver::target(driver::Site::Gaussian, config)),
      rim_(scene.description.cutoff * scene.description.cutoff) {
  driver::check_drawable(scene.description, config);
  gaussians_ = scene::project_all(scene, &projection_, threads);
}

void GaussianSteps::stage(const scene::ProjectedGaussian& real, const Mixture& mixture, StagedSplat& splat,
                          StagedShape& shape) const {
  shape = {};
  shape.own = true;
  shape.tiles = &grid_;
  shape.screen = real.shape;
  shape.word_x = driver::quantise_to<std::int32_t>(real.x, centre_);
  shape.word_y = driver::quantise_to<std::int32_t>(real.y, centre_);
  const bool position = mixture.device(Step::Position);
  splat = {};
  const RoundToFloat& narrow = centre_rounding(mixture);
  splat.x = position ? shape.word_x / centre_.scale : narrow(real.x);
  splat.y = position ? shape.word_y / centre_.scale : narrow(real.y);
  splat.radius = std::sqrt(rim_ * real.shape.xx);
  const scene::ScreenShape footprint{rim_ * real.shape.xx, rim_ * real.shape.xy, rim_ * real.shape.yy};
  set_ellipse(config_, footprint, driver::ellipse_words(config_, footprint), mixture, shape);
  for (std::size_t c = 0; c < 4; ++c) {
    const double value = real.opacity * (c < 3 ? real.colour[static_cast<int>(c)] : 1.0);
    splat.value[c] = mixture.device(Step::Emission)
                         ? static_cast<double>(driver::quantise(value, value_).word) / value_.scale
                         : mixture.rounding(Step::Emission)(value);
  }
}

Staged GaussianSteps::staged(std::span<const std::uint32_t> which, const Mixture& mixture, int threads,
                             Staged memory) const {
  Staged out = std::move(memory);
  out.splats.resize(which.size());
  out.shapes.resize(which.size());
  parallel_parts(which.size(), threads, [&](std::size_t, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) stage(gaussians_[which[i]], mixture, out.splats[i], out.shapes[i]);
  });
  return out;
}

scene::Scene samples_scene(const scene::GaussianScene& scene) {
  scene::SceneDescription description;
  description.method = scene::Method::Westover;
  description.slab_opacity = scene::SlabOpacity::Additive;
  description.camera = scene.description.camera;
  description.width = scene.description.width;
  description.height = scene.description.height;
  description.culling.freeze = scene::kFinished;
  return {.description = description,
          .volume = nullptr,
          .transfer_function = {},
          .kernel = driver::kernel_of(scene.description),
          .camera = scene.camera,
          .shading = {}};
}

}  // namespace fastsplat::stages
