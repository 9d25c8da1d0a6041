// SPDX-License-Identifier: Apache-2.0
// Draws a frame with a hybrid pipeline: each step in device or real arithmetic. All real is golden's picture, all
// device the integer model's, bit for bit. Words are exact in a double, so one chain serves both (docs/errors.md).
#pragma once

#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "analysis/pipeline/density_steps.hpp"
#include "analysis/pipeline/gaussian_steps.hpp"
#include "analysis/pipeline/splat_steps.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"

namespace fastsplat::stages {

/// Premultiplied R, G, B, A of each pixel, row by row.
struct Picture {
  int width = 0, height = 0;
  std::vector<golden::Sums> pixels;
  bool operator==(const Picture&) const = default;
};

/// Every sheet adds its splats in golden's order: by first sheet, then in traversal order (densities: in memory order).
/// The device's sums do not depend on the order.
class Chain {
 public:
  /// Throws UserError (Usage) if the device cannot draw the scene. Keeps references to both.
  Chain(const scene::Scene& scene, const cmodel::Config& config);
  /// Of 3-D Gaussians; throws as GaussianSteps does. All real is golden's picture but for the rounding of doubles.
  Chain(const scene::GaussianScene& scene, const cmodel::Config& config, int threads = 0);

  /// `threads` (0: all cores) never change the result.
  Picture operator()(const Mixture& mixture, int threads = 1) const;

  /// The frame's steps, grouped as they are reported. Of floats, which diffuse no error, if `floats`.
  std::vector<StepSet> sets(bool floats = false) const {
    auto sets = gaussians_ ? gaussian_sets(config_) : step_sets(config_, carries() && !floats, holds_densities());
    return floats ? float_sets(std::move(sets)) : sets;
  }
  bool holds_densities() const { return densities_.has_value(); }
  const DensitySteps& densities() const { return *densities_; }  ///< of sheets that hold densities
  const SplatSteps& steps() const { return *steps_; }            ///< of a volume
  const SplatList& list() const { return list_; }      ///< of a volume
  /// Null for a volume.
  const GaussianSteps* gaussians() const { return gaussians_ ? &*gaussians_ : nullptr; }
  const scene::Scene& scene() const { return scene_; }  ///< of Gaussians: samples_scene()
  const cmodel::Config& config() const { return config_; }
  std::size_t splats() const { return gaussians_ ? gaussians_->gaussians().size() : list_.splats.size(); }
  bool carries() const { return steps_ && steps_->carries(); }
  bool shaped() const { return gaussians_ || steps_->shaped(); }  ///< a frame with ellipses

  /// As SplatSteps::staged(), of all splats.
  Staged staged(const Mixture& mixture, bool golden_units, int threads, Staged memory = {}) const;
  /// Of the splats with the numbers `which`, in the device's units.
  Staged staged(std::span<const std::uint32_t> which, const Mixture& mixture, int threads) const;
  /// As SplatSteps::shares().
  void shares(const StagedSplat& splat, const StagedShape* shape, const Mixture& mixture,
              std::vector<golden::Sums>& out) const;

 private:
  class Band;

  int sheets() const { return steps_ ? steps_->sheets() : 1; }

  std::optional<scene::Scene> own_;  ///< of Gaussians
  const scene::Scene& scene_;
  const cmodel::Config& config_;
  std::optional<SplatSteps> steps_;
  std::optional<GaussianSteps> gaussians_;
  SplatList list_;
  std::optional<DensitySteps> densities_;  ///< only if the sheets hold densities
  mutable std::mutex guard_;
  mutable Staged memory_;  ///< of the frame before: the next one needs as much
};

}  // namespace fastsplat::stages
