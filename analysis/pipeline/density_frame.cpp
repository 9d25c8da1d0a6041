// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/density_frame.hpp"

#include <algorithm>

#include "analysis/pipeline/add_to_sheets.hpp"
#include "analysis/pipeline/product_rule.hpp"

namespace fastsplat::stages {

DensityBand::DensityBand(const Frame& frame, golden::Rows rows)
    : frame_(frame),
      rows_(rows),
      with_halo_{std::max(rows.first - kHalo, 0), std::min(rows.end + kHalo, frame.scene.description.height)},
      width_(frame.scene.description.width),
      height_(frame.scene.description.height),
      all_real_(frame.mixture == Mixture{}),
      cut_(frame.mixture.device(Step::Sheet)),
      sum_(frame.config, cmodel::Site::Sum),
      weights_(frame.scene.kernel, frame.config),
      pixels_(frame.scene, frame.config, frame.mixture, frame.golden_units),
      product_(product_rule(frame.config, frame.mixture)),
      // The sheets that current splats reach, and the two in front of them.
      ring_(static_cast<std::size_t>(frame.steps.reach(frame.mixture)) + 2, golden::Sheet(with_halo_, width_)),
      nothing_(with_halo_, width_),
      picture_(static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(width_), pixels_.initial()),
      material_(static_cast<std::size_t>(width_)),
      settled_(picture_.size(), 0),
      open_(picture_.size()) {}

void DensityBand::run(const BandBins& bins, int band) {
  const int sheets = frame_.steps.sheets();
  const auto neighbour = [&](int sheet) -> const golden::Sheet& {
    return sheet < 0 || sheet >= sheets ? nothing_ : at(sheet);
  };
  for (int sheet = 0; sheet <= sheets && open_ > 0; ++sheet) {
    if (sheet < sheets) {
      for (const std::uint32_t i : bins.bin(band, sheet)) add(frame_.splats.splats[i], frame_.splats.shape(i));
      end(at(sheet));
    }
    if (sheet > 0) classify({sheet - 1, neighbour(sheet - 2), at(sheet - 1), neighbour(sheet)});
    if (sheet > 1) {
      for (int y = with_halo_.first; y < with_halo_.end; ++y) at(sheet - 2).clear_row(y);
    }
  }
}

void DensityBand::store(golden::Sums* out) const {
  for (const golden::Sums& pixel : picture_) *out++ = pixels_.out(pixel);
}

void DensityBand::add(const StagedSplat& splat, const StagedShape* shape) {
  const Mixture& mixture = frame_.mixture;
  weights_.rasterise(splat, shape, mixture, frame_.golden_units, with_halo_, width_);
  frame_.steps.shares(splat, mixture, shares_, shape != nullptr ? shape->growth : Growth{});
  add_to_sheets(splat, weights_, shares_, product_, [this](int sheet) -> golden::Sheet& { return at(sheet); });
}

void DensityBand::end(golden::Sheet& sheet) const {
  if (!cut_) return;
  for (int y = with_halo_.first; y < with_halo_.end; ++y) {
    const golden::Run run = sheet.touched(y);
    for (int x = run.begin; x < run.end; ++x) sheet.row(y)[x][3] = sum_.cut(sheet.row(y)[x][3]);
  }
}

void DensityBand::classify(const golden::SheetWindow& window) {
  for (int y = rows_.first; y < rows_.end; ++y) {
    const golden::Run run = window.here.touched(y);
    if (run.empty()) continue;
    const std::size_t row = static_cast<std::size_t>(y - rows_.first) * static_cast<std::size_t>(width_);
    if (all_real_) {
      const std::span<golden::Sums> pixels = std::span(material_).subspan(static_cast<std::size_t>(run.begin));
      frame_.densities.golden_row(window, y, run.begin, pixels.first(static_cast<std::size_t>(run.size())));
    }
    for (int x = run.begin; x < run.end; ++x) {
      const std::size_t i = row + static_cast<std::size_t>(x);
      if (settled_[i] != 0) continue;
      const golden::Sums sums =
          all_real_ ? material_[static_cast<std::size_t>(x)] : frame_.densities(pixel_of(window, x, y), frame_.mixture);
      if (!pixels_.take(sums, picture_[i])) continue;
      settled_[i] = 1;
      --open_;
    }
  }
}

DensityPixel DensityBand::pixel_of(const golden::SheetWindow& window, int x, int y) const {
  const auto density = [&](const golden::Sheet& sheet, int i, int j) {
    const double sum = sheet.row(j)[i][3];
    return frame_.golden_units ? frame_.densities.part_of_range(sum) : sum;
  };
  const Beside column = beside(x, width_), row = beside(y, height_);
  return {.density = density(window.here, x, y),
          .across = {column.factor * (density(window.here, column.behind, y) - density(window.here, column.before, y)),
                     row.factor * (density(window.here, x, row.behind) - density(window.here, x, row.before)),
                     density(window.behind, x, y) - density(window.before, x, y)},
          .x = x,
          .y = y,
          .sheet = window.number};
}

}  // namespace fastsplat::stages
