// The steps from a splat's place to the weights of its pixels: distance, index, weight.
#pragma once

#include <vector>

#include "cmodel/config.hpp"
#include "driver/quantise.hpp"
#include "golden/splat/footprint.hpp"
#include "scene/kernel.hpp"
#include "stages/splat_steps.hpp"
#include "stages/step.hpp"

namespace fastsplat::stages {

/// Weights are F(u) = exp(-a R^2 u), u the squared distance over the squared radius, 0 from u = 1 on; golden's own,
/// with the kernel's peak in them, where all steps up to the sheets are real ("golden_units").
class WeightSteps {
 public:
  /// Keeps a reference to `kernel`.
  WeightSteps(const scene::Kernel& kernel, const cmodel::Config& config);

  /// Rows and columns of a splat's pixels inside `rows` and an image of `width` columns.
  void rasterise(const StagedSplat& splat, const Mixture& mixture, bool golden_units, golden::Rows rows, int width);

  const std::vector<golden::Footprint::Span>& spans() const { return spans_; }
  std::span<const double> weights(const golden::Footprint::Span& span) const {
    return {weights_ + span.weights, static_cast<std::size_t>(span.width)};
  }
  /// Weight at `entries` radial table entries of squared distance, below N.
  double weight(double entries, const Mixture& mixture) const;

 private:
  /// In table entries, of `pixels` consecutive pixels from `first` on.
  void distances(double centre, double radius, int first, int pixels, bool words, std::vector<double>& out) const;

  const scene::Kernel& kernel_;
  driver::Target rlut_;
  double phases_;
  double entries_;                    ///< N
  double per_entry_;                  ///< 2^-g
  double fall_;                       ///< a R^2 / N
  std::vector<double> real_, words_;  ///< F((t + 1/2) / N); RADIAL[t] 2^-wf
  golden::Footprint golden_;
  std::vector<golden::Footprint::Span> spans_;
  std::vector<double> across_, down_, own_;
  const double* weights_ = nullptr;
};

}  // namespace fastsplat::stages
