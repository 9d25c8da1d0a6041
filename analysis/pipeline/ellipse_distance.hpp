// SPDX-License-Identifier: Apache-2.0
// Step `distance` of an ellipse: q at its pixels, in radial table entries.
#pragma once

#include <span>
#include <vector>

#include "analysis/pipeline/splat_steps.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "driver/splats/ellipse_shape.hpp"
#include "golden/splat/footprint.hpp"

namespace fastsplat::stages {

/// Real: q of the shape, where it is below N. Device: q at the pixels of the records' windows, at least 0, from six
/// coefficients, each rounded once at the record's first pixel. If shape or centre are real, the coefficients of the
/// reals are rounded there.
class EllipseDistance {
 public:
  explicit EllipseDistance(const cmodel::Config& config)
      : config_(config), unit_(config), step_(config.rlut_guard_bits + config.ellipse_format().frac_bits) {}

  /// visit(y, x, entries): rows of pixels from x on, inside `rows` and an image of `width` columns, with q at each
  /// pixel.
  template <class Visit>
  void rows(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture, golden::Rows rows, int width,
            Visit visit) {
    if (!mixture.device(Step::Distance)) {
      const auto clip = [](double at, int low, int high) {
        return static_cast<int>(std::clamp(at, 1.0 * low, 1.0 * high));
      };
      const int left = clip(std::ceil(splat.x - shape.reach_x), 0, width),
                right = clip(std::floor(splat.x + shape.reach_x) + 1.0, 0, width),
                top = clip(std::ceil(splat.y - shape.reach_y), rows.first, rows.end),
                bottom = clip(std::floor(splat.y + shape.reach_y) + 1.0, rows.first, rows.end);
      for (int y = top; y < bottom; ++y) {
        entries_.clear();
        const double dy = y - splat.y;
        for (int x = left; x < right; ++x) {
          const double dx = x - splat.x;
          entries_.push_back(std::max(shape.a * dx * dx + shape.b * dx * dy + shape.c * dy * dy, 0.0));
        }
        visit(y, left, std::span<const double>(entries_));
      }
      return;
    }
    for (const driver::EllipseSpan& span : driver::EllipseSpans(config_, shape.words, shape.word_x, shape.word_y)) {
      begin(splat, shape, mixture, span.windows);
      const int lanes = config_.lanes, columns = static_cast<int>(span.windows.columns) * lanes,
                height = static_cast<int>(span.windows.rows) * lanes;
      const int left = std::max(left_, 0), right = std::min(left_ + columns, width);
      for (int y = std::max(top_, rows.first); y < std::min(top_ + height, rows.end) && left < right; ++y) {
        entries_.clear();
        for (int x = left; x < right; ++x) entries_.push_back(at(x - left_, y - top_));
        visit(y, left, std::span<const double>(entries_));
      }
    }
  }

 private:
  /// Coefficients of a record at its first pixel, (left_, top_).
  void begin(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture,
             const cmodel::EllipseWindows& windows);
  /// Entries at pixel (i, j), counted from there.
  double at(int i, int j) const;

  const cmodel::Config& config_;
  cmodel::EllipseUnit unit_;
  int step_;  ///< fraction bits of a coefficient in table entries
  int left_ = 0, top_ = 0;
  cmodel::EllipseCoefficients words_;
  std::vector<double> entries_;
};

}  // namespace fastsplat::stages
