// SPDX-License-Identifier: Apache-2.0
#include "golden/sheet_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "golden/bands.hpp"
#include "golden/settled_pixels.hpp"
#include "golden/sheet.hpp"
#include "golden/splat/composite.hpp"
#include "golden/splat/footprint.hpp"
#include "golden/splat/projection.hpp"
#include "golden/splat_sums.hpp"
#include "scene/kernel_growth.hpp"

namespace fastsplat::golden {

int KernelSlices::reach() const {
  // 2R/W slabs, one more if the ends fall inside slabs, and one more for the rounding of the ends' positions.
  return std::min(grid_.count, static_cast<int>(std::ceil(2.0 * kernel_.radius() * largest_growth_ / grid_.width)) + 2);
}

int KernelSlices::first(const ProjectedSplat& splat) const {
  const double slab = std::floor((splat.z - kernel_.radius() * splat.depth_growth - grid_.first) / grid_.width);
  return static_cast<int>(std::clamp(slab, 0.0, grid_.count - 1.0));
}

void KernelSlices::shares(const ProjectedSplat& splat, std::vector<double>& out) const {
  assert(splat.depth_growth <= largest_growth_ * (1.0 + 1e-6));  // positions are float
  out.clear();
  double in_front = 0.0;  // share of the splat in front of the current slab
  for (int slab = first(splat); slab < grid_.count && in_front < 1.0; ++slab) {
    const bool last = slab == grid_.count - 1;
    const double z1 = grid_.first + (slab + 1) * grid_.width;
    const double behind_slab = last ? 1.0 : kernel_.cumulative((z1 - splat.z) / splat.depth_growth);
    out.push_back(behind_slab - in_front);
    in_front = behind_slab;
  }
}

KernelSlices image_slabs(const scene::Scene& scene) {
  return {scene.kernel, scene::sheet_plan(scene, scene::Method::ImageAligned).slabs, scene::largest_growth(scene)};
}

namespace {

/// Thin slabs need long rings. Bands are then narrower, to keep a thread's ring below this many bytes.
constexpr double kRingBytes = 64e6;

int rows_for_ring(int sheets, int width) {
  const double row_bytes = static_cast<double>(sheets) * width * sizeof(Sums);
  return static_cast<int>(std::clamp(kRingBytes / row_bytes, 4.0, 16.0));
}

/// Sweeps the sheets of one band of rows.
class BandSweep {
 public:
  BandSweep(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const SheetAssignment& assignment,
            const SheetSink& sink, Rows rows)
      : scene_(scene),
        splats_(splats),
        assignment_(assignment),
        sink_(sink),
        rows_(rows),
        width_(scene.camera.width()),
        ring_(assignment.reach(), Sheet(rows, width_)),
        pixels_(static_cast<std::size_t>(rows.end - rows.first) * width_, sink.initial) {}
  virtual ~BandSweep() = default;

  /// Visits splats by their nearest sheet.
  void run(const Projector& project, const BandIndex& index, int band) {
    for (int sheet = 0; sheet < assignment_.sheets(); ++sheet) {
      add(sheet, project, index.bucket(band, sheet));
      drain(at(sheet));
    }
  }

  std::uint64_t hidden() const { return hidden_; }  ///< splats not drawn

  void store(float* out, int channels) const {
    for (const Sums& pixel : pixels_) {
      sink_.store(pixel, out);
      out += channels;
    }
  }

 protected:
  Sheet& at(int sheet) { return ring_[static_cast<std::size_t>(sheet) % ring_.size()]; }
  std::span<Sums> pixels(int y, Run run) {
    return std::span(pixels_).subspan(static_cast<std::size_t>(y - rows_.first) * width_ + run.begin, run.size());
  }
  void take(const Sheet& sheet, int y, Run run) {
    sink_.take(pixels(y, run), std::span(sheet.row(y) + run.begin, static_cast<std::size_t>(run.size())));
  }

  const scene::Scene& scene_;
  const std::vector<scene::Splat>& splats_;
  const SheetAssignment& assignment_;
  const SheetSink& sink_;
  const Rows rows_;
  const int width_;
  Footprint footprint_;
  std::vector<double> shares_;
  std::uint64_t hidden_ = 0;

 private:
  /// Adds the splats whose nearest sheet this is.
  virtual void add(int sheet, const Projector& project, std::span<const std::uint32_t> bucket) = 0;
  /// Passes the touched runs to the sink and clears the sheet.
  virtual void drain(Sheet& sheet) = 0;

  std::vector<Sheet> ring_;
  std::vector<Sums> pixels_;
};

/// The definition, without shortcuts.
class PlainBandSweep final : public BandSweep {
 public:
  using BandSweep::BandSweep;

 private:
  void add(int sheet, const Projector& project, std::span<const std::uint32_t> bucket) override {
    for (const std::uint32_t i : bucket) {
      const ProjectedSplat splat = project(splats_[i]);
      footprint_.rasterise(scene_.kernel, splat, rows_, width_);
      assignment_.shares(splat, shares_);
      assert(static_cast<int>(shares_.size()) <= assignment_.reach());
      for (std::size_t s = 0; s < shares_.size(); ++s) {
        at(sheet + static_cast<int>(s)).add(footprint_, scaled(splat.value, shares_[s]));
      }
    }
  }

  void drain(Sheet& sheet) override {
    for (int y = rows_.first; y < rows_.end; ++y) {
      const Run touched = sheet.touched(y);
      if (touched.empty()) continue;
      take(sheet, y, touched);
      sheet.clear_row(y);
    }
  }
};

/// The same pixels with vectors, without splats hidden by settled pixels.
class FastBandSweep final : public BandSweep {
 public:
  FastBandSweep(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const SheetAssignment& assignment,
                const SheetSink& sink, Rows rows)
      : BandSweep(scene, splats, assignment, sink, rows), settled_(rows, width_) {}

 private:
  void add(int sheet, const Projector& project, std::span<const std::uint32_t> bucket) override {
    if (bucket.empty()) return;
    std::vector<Run> touched(rows_.end - rows_.first, Run{width_, 0});  // by any of the splats
    std::size_t reached = 0;                                            // sheets
    for (const std::uint32_t i : bucket) {
      const ProjectedSplat splat = project(splats_[i]);
      const Rows open = settled_.open_rows(splat, rows_);
      if (open.first >= open.end) {
        ++hidden_;
        continue;
      }
      footprint_.rasterise(scene_.kernel, splat, open, width_);
      assignment_.shares(splat, shares_);
      assert(static_cast<int>(shares_.size()) <= assignment_.reach());
      sums_.clear();
      for (std::size_t s = 0; s < shares_.size(); ++s) {
        sums_.add(at(sheet + static_cast<int>(s)), rows_.first, scaled(splat.value, shares_[s]));
      }
      sums_.add_footprint(footprint_);
      for (const Footprint::Span& span : footprint_.spans()) {
        Run& run = touched[span.y - rows_.first];
        run = {std::min(run.begin, span.x), std::max(run.end, span.x + span.width)};
      }
      reached = std::max(reached, shares_.size());
    }
    for (std::size_t s = 0; s < reached; ++s) {
      for (int y = rows_.first; y < rows_.end; ++y) at(sheet + static_cast<int>(s)).touch(y, touched[y - rows_.first]);
    }
  }

  void drain(Sheet& sheet) override {
    for (int y = rows_.first; y < rows_.end; ++y) {
      const Run touched = sheet.touched(y);
      if (touched.empty()) continue;
      for (int begin = settled_.next_open(touched.begin, touched.end, y); begin < touched.end;) {
        const Run open{begin, settled_.next_settled(begin, touched.end, y)};
        take(sheet, y, open);
        if (sink_.settled) settle(y, open);
        begin = settled_.next_open(open.end, touched.end, y);
      }
      sheet.clear_row(y);
    }
  }

  void settle(int y, Run run) {
    const std::span<const Sums> row = pixels(y, run);
    for (int i = 0; i < run.size(); ++i) {
      if (sink_.settled(row[i])) settled_.settle(run.begin + i, y);
    }
  }

  SettledPixels settled_;
  SplatSums sums_;  ///< of the current splat
};

}  // namespace

Image sweep_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                   const SheetAssignment& assignment, const SheetSink& sink) {
  const int width = scene.camera.width();
  const int height = scene.camera.height();
  Image image(width, height);
  const Projector project(scene);
  const Bands bands{height, rows_for_ring(assignment.reach(), width)};
  const BandIndex index(scene, splats, bands, assignment.sheets(), options.threads,
                        [&](const ProjectedSplat& splat) { return assignment.first(splat); });

  std::atomic<std::uint64_t> hidden = 0;
  for_each_band(index.splats_per_band(), options.threads, options.progress, [&](int band) {
    const auto sweep = [&](auto&& unit) {
      unit.run(project, index, band);
      unit.store(image.pixel(0, bands.rows(band).first), image.channels);
      hidden += unit.hidden();
    };
    if (options.plain) {
      sweep(PlainBandSweep(scene, splats, assignment, sink, bands.rows(band)));
    } else {
      sweep(FastBandSweep(scene, splats, assignment, sink, bands.rows(band)));
    }
  });
  if (options.report) options.report->footprints = index.size(), options.report->hidden_footprints = hidden;
  return image;
}

Image composite_sheets(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options,
                       const SheetAssignment& assignment) {
  const scene::SlabOpacity opacity = scene.description.slab_opacity;
  const double freeze = scene.description.culling.freeze;
  const auto of = [](const Sums& pixel) { return FrontToBack{pixel[0], pixel[1], pixel[2], pixel[3]}; };
  const bool bounded = never_brighter_than_opaque(splats);
  const SheetSink sink{
      .initial = {0.0, 0.0, 0.0, 1.0},
      .take =
          [opacity, freeze, of](std::span<Sums> pixels, std::span<const Sums> sheet) {
            for (std::size_t i = 0; i < pixels.size(); ++i) {
              if (!(sheet[i][3] > 0.0) || pixels[i][3] < freeze) continue;
              FrontToBack pixel = of(pixels[i]);
              pixel.add(make_layer(sheet[i], opacity));
              pixels[i] = {pixel.red, pixel.green, pixel.blue, pixel.transmittance};
            }
          },
      .store = [of](const Sums& pixel, float* rgba) { of(pixel).store(rgba); },
      .settled = [freeze, bounded,
                  of](const Sums& pixel) { return pixel[3] < freeze || (bounded && settled(of(pixel))); }};
  return sweep_sheets(scene, splats, options, assignment, sink);
}

}  // namespace fastsplat::golden
