// SPDX-License-Identifier: Apache-2.0
// The steps from a splat's position to the weights of its pixels: distance, index, weight.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "analysis/pipeline/ellipse_distance.hpp"
#include "analysis/pipeline/float_distance.hpp"
#include "analysis/pipeline/splat_steps.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/sites.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tiles/tile_bins.hpp"
#include "golden/splat/footprint.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::stages {

/// How far beyond a splat's radius its pixels can have weight: index.kind linear rounds distances down.
inline double more_reach(const cmodel::Config& config) {
  return config.index() == cmodel::IndexKind::Linear ? 1.0 / config.grid() : 0.0;
}

/// Weights are F(u) = exp(-a R^2 u), u the squared distance over the squared radius, and 0 from u = 1 on. If all steps
/// up to sheet are real ("golden_units"), they are golden's own, which contain the kernel's peak.
class WeightSteps {
 public:
  /// Keeps references.
  WeightSteps(const scene::Kernel& kernel, const cmodel::Config& config);

  /// Computes spans and weights of a splat's pixels inside `rows` and an image of `width` columns. `shape`: null in a
  /// frame without ellipses.
  void rasterise(const StagedSplat& splat, const StagedShape* shape, const Mixture& mixture, bool golden_units,
                 golden::Rows rows, int width);

  /// What the last splat has at the followed pixel.
  struct Followed {
    std::optional<double> entries;  ///< distance in radial table entries, as for weight(); some kinds have none
    double weight = 0.0;
  };
  /// From now on follows column x of the rows that are rasterised, which must be one row.
  void follow(int x) { followed_x_ = x; }
  /// Empty if the splat has no weight there.
  std::optional<Followed> followed() const;

  const std::vector<golden::Footprint::Span>& spans() const { return spans_; }
  std::span<const double> weights(const golden::Footprint::Span& span) const {
    return {weights_ + span.weights, static_cast<std::size_t>(span.width)};
  }
  /// Weight at `entries` < N radial table entries: of squared distance, for index.kind linear of distance.
  double weight(double entries, const Mixture& mixture) const;

 private:
  /// weight() of an interpolated table.
  double interpolated(double entries, const Mixture& mixture) const;
  /// How a radius scales distances.
  struct Rim {
    double radius = -1.0;  ///< pixels
    driver::Scale scale;   ///< for kinds that compute distances
  };
  void rasterise_golden(const StagedSplat& splat, const StagedShape* shape, golden::Rows rows, int width);
  void rasterise_circle(const StagedSplat& splat, const Mixture& mixture, golden::Rows rows, int width);
  void rasterise_ellipse(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture, golden::Rows rows,
                         int width);
  /// Adds the pixels of row y from x on that lie inside the edge; `entries`(i) of the i-th of `count`.
  template <class Entries>
  void add_row(int y, int x, int count, Entries entries, const Mixture& mixture);
  // Where float_distances():
  void rasterise_floats(const StagedSplat& splat, const Mixture& mixture, const driver::Extent& box);
  void rasterise_floats(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture,
                        const driver::Extent& box);
  /// Adds the pixels of row y in [x, x_end) with square(i) < 1 at the i-th: squared distance over squared radius.
  template <class Square>
  void add_float_row(int y, int x, int x_end, const Mixture& mixture, Square square);
  double float_weight(double u, const Mixture& mixture) const;
  void rasterise_rlut(const StagedSplat& splat, const Mixture& mixture, const driver::Extent& box);
  void rasterise_other(const StagedSplat& splat, const Mixture& mixture, const driver::Extent& box);
  /// Distances of pixels first..end-1 in table entries: RLUT words, or the reals behind them.
  void distances(double centre, double radius, int first, int end, bool words, std::vector<double>& out) const;
  /// Step distance of kinds without an RLUT: radial table entries at (dx, dy) pixels.
  double computed(double dx, double dy, const Rim& rim, bool device) const;
  double other_weight(double dx, double dy, const Rim& rim, const Mixture& mixture) const;

  const scene::Kernel& kernel_;
  const cmodel::Config& config_;
  driver::Target rlut_, axis_, footprint_;
  cmodel::Narrowing axis_product_, radial_fall_;
  double grid_;                       ///< K
  double entries_;                    ///< N
  double per_entry_;                  ///< 2^-g
  double fall_;                       ///< a R^2
  std::vector<double> real_, words_;  ///< the sample of entry t; RADIAL[t] 2^-wf
  Rim rim_;
  EllipseDistance ellipse_;
  golden::Footprint golden_;
  std::vector<golden::Footprint::Span> spans_;
  std::vector<double> across_, down_, own_, squares_;
  std::array<std::vector<FloatOffset>, 2> offsets_;
  const double* weights_ = nullptr;
  std::optional<int> followed_x_;
  std::optional<double> followed_entries_;
};

}  // namespace fastsplat::stages
