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
#include "driver/tiles/gaussian_windows.hpp"
#include "golden/sheet.hpp"
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
      const driver::Extent box = pixels_about(splat.x, splat.y, shape.reach_x, shape.reach_y, rows, width);
      for (int y = box.y0; y < box.y1; ++y) {
        entries_.clear();
        const double dy = y - splat.y;
        for (int x = box.x0; x < box.x1; ++x) {
          const double dx = x - splat.x;
          entries_.push_back(std::max(shape.a * dx * dx + shape.b * dx * dy + shape.c * dy * dy, 0.0));
        }
        visit(y, box.x0, std::span<const double>(entries_));
      }
      return;
    }
    const auto record = [&](const cmodel::EllipseWindows& windows, golden::Run inside, golden::Rows open) {
      begin(splat, shape, mixture, windows);
      const int columns = static_cast<int>(windows.columns) * config_.lanes,
                height = static_cast<int>(windows.rows) * config_.lanes;
      const int left = std::max(left_, inside.begin), right = std::min(left_ + columns, inside.end);
      for (int y = std::max(top_, open.first); y < std::min(top_ + height, open.end) && left < right; ++y) {
        entries_.clear();
        for (int x = left; x < right; ++x) entries_.push_back(at(x - left_, y - top_));
        visit(y, left, std::span<const double>(entries_));
      }
    };
    if (shape.tiles != nullptr) return of_tiles(splat, shape, rows, record);
    for (const driver::EllipseSpan& span : driver::EllipseSpans(config_, shape.words, shape.word_x, shape.word_y))
      record(span.windows, {0, width}, rows);
  }

 private:
  /// Calls record(windows, columns, rows) for the records of a Gaussian in each tile.
  template <class Record>
  void of_tiles(const StagedSplat& splat, const StagedShape& shape, golden::Rows rows, const Record& record) {
    const driver::TileGrid& grid = *shape.tiles;
    const auto tile_of = [&](double x) {
      return static_cast<int>(std::clamp(std::floor(x / grid.tile_width), 0.0, grid.columns() - 1.0));
    };
    const int first = tile_of(splat.x - shape.reach_x - 1.0), last = tile_of(splat.x + shape.reach_x + 1.0);
    for (int down = rows.first / grid.tile_height; down * grid.tile_height < rows.end; ++down) {
      for (int across = first; across <= last; ++across) {
        const int tile = down * grid.columns() + across, x = grid.x(tile), y = grid.y(tile);
        const golden::Rows open{std::max(rows.first, y), std::min(rows.end, y + grid.height(tile))};
        const std::int32_t pixel = 1 << config_.position_frac_bits;
        for (const cmodel::EllipseWindows& windows :
             driver::gaussian_windows(config_, shape.words, shape.word_x - x * pixel, shape.word_y - y * pixel,
                                      grid.width(tile), grid.height(tile)))
          record(windows, {x, x + grid.width(tile)}, open);
      }
    }
  }
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
