// SPDX-License-Identifier: Apache-2.0
#include "golden/frame_sweep.hpp"

#include <fmt/format.h>

#include <cassert>
#include <functional>
#include <optional>

#include "base/error.hpp"
#include "base/parallel/parallel.hpp"
#include "golden/bands.hpp"
#include "golden/splat/projection.hpp"
#include "golden/splat_sums.hpp"

namespace fastsplat::golden {
namespace {

class FrameSweep {
 public:
  FrameSweep(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
             const SheetAssignment& assignment, const FrameStages& stages)
      : scene_(scene),
        splats_(splats),
        options_(options),
        assignment_(assignment),
        stages_(stages),
        width_(scene.camera.width()),
        height_(scene.camera.height()),
        project_(scene),
        bands_{height_},
        pixels_(static_cast<std::size_t>(width_) * height_),
        footprints_(bands_.count()),
        shares_(bands_.count()),
        sums_(bands_.count()),
        visible_in_(bands_.count()),
        changed_(height_) {
    for (const SheetStage* stage : stages.sheet_stages) {
      needs_neighbours_ |= stage->needs_neighbours();
      margin_ += stage->margin();
    }
    if (stages.filter) {
      margin_ += stages.filter->margin();
      layers_ = {width_, std::vector<Layer>(pixels_.size()), std::vector<Run>(height_)};
    }
    if (!stages.occlusion) {
      index_.emplace(scene, splats, bands_, assignment.sheets(), options.threads,
                     [&assignment](const ProjectedSplat& splat) { return assignment.first(splat); });
    }
    // Live at once: all sheets that the current splats reach and, if neighbours are read, the two in front of them.
    const int live = assignment.reach() + (needs_neighbours_ ? 2 : 0);
    check_memory(live);
    ring_.assign(live, Sheet({0, height_}, width_));
    if (needs_neighbours_) nothing_.emplace(Rows{0, height_}, width_);
  }

  Image run() {
    const int sheets = assignment_.sheets();
    for (int sheet = 0; sheet < sheets; ++sheet) {
      splat_sheet(sheet);
      if (stages_.sheet_stages.empty()) {
        finish_plain(sheet);
      } else if (!needs_neighbours_) {
        const Sheet& here = at(sheet);
        finish({sheet, here, here, here});
        clear(sheet);
      } else {
        if (sheet > 0) finish({sheet - 1, neighbour(sheet - 2), at(sheet - 1), at(sheet)});
        if (sheet > 1) clear(sheet - 2);
      }
      if (options_.progress && sheet + 1 < sheets) options_.progress(sheet + 1, sheets);
    }
    if (needs_neighbours_ && sheets > 0) {
      finish({sheets - 1, neighbour(sheets - 2), at(sheets - 1), neighbour(sheets)});
    }
    Image image(width_, height_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) pixels_[i].store(&image.data[4 * i]);
    if (options_.progress) options_.progress(sheets, sheets);
    return image;
  }

 private:
  void check_memory(int live) const {
    const double bytes = static_cast<double>(live) * static_cast<double>(pixels_.size()) * sizeof(Sums);
    if (bytes <= kFrameSweepBytes) return;
    throw_usage({.where = {},
                 .what = fmt::format("{} sheets of {}x{} pixels must be in memory at once", live, width_, height_),
                 .expected = fmt::format("at most {:.0f} GB", kFrameSweepBytes * 1e-9),
                 .got = fmt::format("{:.1f} GB", bytes * 1e-9),
                 .fix = "use a larger slab width or a smaller image"});
  }

  Sheet& at(int sheet) { return ring_[static_cast<std::size_t>(sheet) % ring_.size()]; }
  const Sheet& neighbour(int sheet) { return sheet < 0 || sheet >= assignment_.sheets() ? *nothing_ : at(sheet); }

  void for_each_row_band(const std::function<void(int band, Rows rows)>& work) const {
    parallel_for(static_cast<std::size_t>(bands_.count()), options_.threads,
                 [&](std::size_t band) { work(static_cast<int>(band), bands_.rows(static_cast<int>(band))); });
  }

  /// Visibility is decided for all bands before the sheet's first splat is drawn, from the picture at that moment.
  void splat_sheet(int sheet) {
    std::span<const ProjectedSplat> visible;
    if (stages_.occlusion) {
      visible = stages_.occlusion->visible(sheet, margin_);
      for (std::vector<std::uint32_t>& indices : visible_in_) indices.clear();
      for (std::uint32_t i = 0; i < visible.size(); ++i) {
        const BandRange reached = bands_of(visible[i], bands_, width_);
        for (int band = reached.first; band < reached.end; ++band) visible_in_[band].push_back(i);
      }
    }
    for_each_row_band([&](int band, Rows rows) {
      if (stages_.occlusion) {
        for (const std::uint32_t i : visible_in_[band]) splat_rows(sheet, visible[i], band, rows);
      } else {
        for (const std::uint32_t i : index_->bucket(band, sheet)) {
          splat_rows(sheet, project_(splats_[i]), band, rows);
        }
      }
    });
  }

  void splat_rows(int sheet, const ProjectedSplat& splat, int band, Rows rows) {
    Footprint& footprint = footprints_[band];
    std::vector<double>& shares = shares_[band];
    footprint.rasterise(scene_.kernel, splat, rows, width_);
    assignment_.shares(splat, shares);
    assert(static_cast<int>(shares.size()) <= assignment_.reach());
    if (!stages_.deposit && !options_.plain) return add_to_sheets(sheet, splat, band);
    for (int s = 0; s < static_cast<int>(shares.size()); ++s) {
      if (stages_.deposit) {
        stages_.deposit->add(at(sheet + s), sheet + s, footprint, splat, shares[s]);
      } else {
        at(sheet + s).add(footprint, scaled(splat.value, shares[s]));
      }
    }
  }

  /// Sheet::add on all sheets at once.
  void add_to_sheets(int sheet, const ProjectedSplat& splat, int band) {
    SplatSums& sums = sums_[band];
    sums.clear();
    for (int s = 0; s < static_cast<int>(shares_[band].size()); ++s) {
      sums.add(at(sheet + s), 0, scaled(splat.value, shares_[band][s]));
      for (const Footprint::Span& span : footprints_[band].spans()) {
        at(sheet + s).touch(span.y, {span.x, span.x + span.width});
      }
    }
    sums.add_footprint(footprints_[band]);
  }

  void clear(int sheet) {
    for_each_row_band([&](int, Rows rows) {
      for (int y = rows.first; y < rows.end; ++y) at(sheet).clear_row(y);
    });
  }

  /// Runs the stages, makes layers, filters and composites them.
  void finish(const SheetWindow& window) {
    const bool filtered = stages_.filter && !stages_.filter->leaves(window.number);
    for_each_row_band([&](int, Rows rows) {
      std::vector<Sums> material(width_);
      for (int y = rows.first; y < rows.end; ++y) {
        Run run = window.here.touched(y);
        for (const SheetStage* stage : stages_.sheet_stages) run = stage->extent(window, y, run);
        if (run.empty()) run = {};
        std::copy(window.here.row(y) + run.begin, window.here.row(y) + run.end, material.begin() + run.begin);
        const std::span<Sums> pixels = std::span(material).subspan(run.begin, run.size());
        for (const SheetStage* stage : stages_.sheet_stages) stage->row(window, y, run.begin, pixels);
        hand_over(y, run, pixels, filtered);
      }
    });
    after_layers(window.number, filtered);
  }

  /// finish() and clear() in one pass, while each row is in cache.
  void finish_plain(int number) {
    Sheet& sheet = at(number);
    const bool filtered = stages_.filter && !stages_.filter->leaves(number);
    for_each_row_band([&](int, Rows rows) {
      for (int y = rows.first; y < rows.end; ++y) {
        const Run run = sheet.touched(y).empty() ? Run{} : sheet.touched(y);
        hand_over(y, run, {sheet.row(y) + run.begin, static_cast<std::size_t>(run.size())}, filtered);
        sheet.clear_row(y);
      }
    });
    after_layers(number, filtered);
  }

  void hand_over(int y, Run run, std::span<const Sums> material, bool filtered) {
    if (filtered) {
      to_layers(y, run, material);
    } else {
      composite(y, run, material);
    }
  }

  void after_layers(int sheet, bool filtered) {
    if (filtered) composite_filtered(sheet);
    if (stages_.occlusion) stages_.occlusion->composited(pixels_, changed_);
  }

  FrontToBack* picture_row(int y) { return &pixels_[static_cast<std::size_t>(y) * width_]; }

  void composite(int y, Run run, std::span<const Sums> material) {
    changed_[y] = run;
    for (int i = 0; i < run.size(); ++i) {
      FrontToBack& pixel = picture_row(y)[run.begin + i];
      if (!(material[i][3] > 0.0) || pixel.transmittance < stages_.freeze_below) continue;
      pixel.add(make_layer(material[i], scene_.description.slab_opacity));
    }
  }

  void to_layers(int y, Run run, std::span<const Sums> material) {
    layers_.runs[y] = run;
    Layer* layers = &layers_.layers[static_cast<std::size_t>(y) * width_ + run.begin];
    for (int i = 0; i < run.size(); ++i) {
      layers[i] = material[i][3] > 0.0 ? make_layer(material[i], scene_.description.slab_opacity) : Layer{};
    }
  }

  void composite_filtered(int sheet) {
    const LayerFilter& filter = *stages_.filter;
    for_each_row_band([&](int, Rows rows) {
      std::vector<Layer> filtered(width_);
      for (int y = rows.first; y < rows.end; ++y) {
        const Run run = filter.extent(sheet, layers_, y);
        changed_[y] = run;
        if (run.empty()) continue;
        filter.row(sheet, layers_, y, run.begin, std::span(filtered).first(run.size()));
        for (int i = 0; i < run.size(); ++i) {
          FrontToBack& pixel = picture_row(y)[run.begin + i];
          if (filtered[i].alpha > 0.0 && !(pixel.transmittance < stages_.freeze_below)) pixel.add(filtered[i]);
        }
      }
    });
  }

  const scene::Scene& scene_;
  const std::vector<scene::Splat>& splats_;
  const RenderOptions& options_;
  const SheetAssignment& assignment_;
  const FrameStages& stages_;
  int width_, height_;
  Projector project_;
  Bands bands_;
  std::optional<BandIndex> index_;  ///< without Occlusion
  std::vector<FrontToBack> pixels_;
  std::vector<Footprint> footprints_;        ///< one per band
  std::vector<std::vector<double>> shares_;  ///< one per band
  std::vector<SplatSums> sums_;              ///< one per band
  bool needs_neighbours_ = false;
  int margin_ = 0;
  std::vector<Sheet> ring_;
  std::optional<Sheet> nothing_;
  LayerFrame layers_;
  std::vector<std::vector<std::uint32_t>> visible_in_;  ///< with Occlusion: per band, of the sheet's visible splats
  std::vector<Run> changed_;                            ///< per row, of the sheet composited last
};

}  // namespace

Image sweep_frame(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                  const SheetAssignment& assignment, const FrameStages& stages) {
  return FrameSweep(scene, splats, options, assignment, stages).run();
}

}  // namespace fastsplat::golden
