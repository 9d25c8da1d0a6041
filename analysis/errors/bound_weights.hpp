// SPDX-License-Identifier: Apache-2.0
// The bound of a splat's weight at a pixel: what is known of it, and the most that the device's differs
// (docs/errors.md, section 3). Circles and ellipses alike: q is a quadratic form of the way from the centre.
#pragma once

#include <cstdint>

#include "analysis/errors/roundings.hpp"
#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "driver/tiles/tile_bins.hpp"

namespace fastsplat::analysis {

/// A splat at a pixel.
struct Touch {
  double weight = 0.0, error = 0.0;  ///< known weight; largest error of the device's
  double by_place = 0.0, by_radius = 0.0, by_lookup = 0.0, by_weight = 0.0;  ///< parts of the error
};

/// The splats of a frame as far as they are known.
struct KnownSplats {
  /// `known`: the steps whose results are known.
  KnownSplats(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings, int threads);
  /// The device's own radius or shape at the known place. Null if it is known, or in a frame of circles.
  const stages::StagedSplat* drawn(std::size_t i) const { return device.splats.empty() ? nullptr : &device.splats[i]; }

  stages::Staged known;
  stages::Staged device;  ///< with step radius the device's; empty unless it is open in a frame with ellipses
};

class WeightBound {
 public:
  /// Keeps references.
  WeightBound(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings,
              const KnownSplats& splats);

  /// Selects a splat.
  void begin(std::size_t i);
  /// The factor of the device's values to the known ones: the square of the radii's ratio, or what a thin ellipse
  /// loses.
  double ratio() const { return ratio_; }
  /// Pixels outside have no weight on either side.
  driver::Extent extent() const;
  /// visit(x, y, touch) of the splat's pixels within `rows` and an image of `width` columns, row by row; none without
  /// weight on both sides.
  template <class Visit>
  void visit(golden::Rows rows, int width, Visit visit) {
    if (exact_) {
      weights_.rasterise(*splat_, shape_, known_, false, rows, width);
      for (const auto& span : weights_.spans()) {
        const auto weights = weights_.weights(span);
        for (int p = 0; p < span.width; ++p) {
          Touch touch;
          touch.weight = weights[static_cast<std::size_t>(p)];
          if (touch.weight > 0.0) visit(span.x + p, span.y, touch);
        }
      }
      return;
    }
    const driver::Extent box = extent();
    for (int y = std::max(box.y0, rows.first); y < std::min(box.y1, rows.end); ++y) {
      for (int x = std::max(box.x0, 0); x < std::min(box.x1, width); ++x) {
        const Touch touch = at(x, y);
        if (touch.weight + touch.error > 0.0) visit(x, y, touch);
      }
    }
  }
  /// Spans of the known weights, and the weights, within `rows`.
  const stages::WeightSteps& rasterise(golden::Rows rows, int width) {
    weights_.rasterise(*splat_, shape_, known_, false, rows, width);
    return weights_;
  }

 private:
  /// q = a dx^2 + b dx dy + c dy^2 in radial table entries, dx and dy in pixels.
  struct Form {
    double a = 0.0, b = 0.0, c = 0.0;
    double at(double dx, double dy) const { return a * dx * dx + b * dx * dy + c * dy * dy; }
    /// The least and the largest q within `place` of (dx, dy) along both axes.
    double least(double dx, double dy, double place) const;
    double greatest(double dx, double dy, double place) const;
  };

  Touch at(int x, int y) const;
  /// The most that an ellipse's q is off at a pixel by the rounding of its coefficients.
  double coefficients(int x, int y) const;

  const stages::Chain& chain_;
  const stages::Mixture& known_;
  const Roundings& r_;
  const KnownSplats& splats_;
  bool exact_;      ///< weights are known
  double entries_;  ///< N
  stages::WeightSteps weights_;
  const stages::StagedSplat* splat_ = nullptr;
  const stages::StagedShape* shape_ = nullptr;  ///< null for circles
  Form own_, drawn_;                            ///< known, and the device's
  double place_ = 0.0, ratio_ = 1.0;
  bool moved_ = false;                    ///< the device's form or ratio differs
  double reach_x_ = 0.0, reach_y_ = 0.0;  ///< from the centre; on either side there is no weight beyond
  double near_x_ = 0.0, near_y_ = 0.0;    ///< of an ellipse: no record begins before this pixel
  double clipped_ = 0.0;                  ///< of a Gaussian: farther along an axis a record may not reach
};

}  // namespace fastsplat::analysis
