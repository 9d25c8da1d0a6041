// SPDX-License-Identifier: Apache-2.0
// The sweep over whole sheets. Without stages it equals the band sweep bit for bit. Stages that read neighbouring
// pixels give the same result for every number of threads. It splats the visible, as occlusion computes it from the
// picture in front.
#include "golden/frame_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "golden/splat/projection.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::SlabOpacity;

Lattice view() {
  Lattice lattice;
  lattice.dims = {14, 9, 11};
  lattice.azimuth = 200;
  lattice.elevation = -35;
  lattice.projection = scene::Projection::Perspective;
  lattice.pixels_per_mm = 6;  // part of it lies outside the picture
  lattice.width = 71;
  lattice.height = 53;  // not a multiple of the band's rows
  return lattice;
}

KernelSlices slices(const scene::Scene& scene) { return image_slabs(scene); }

/// Does not change the sums.
class Idle final : public SheetStage {
 public:
  explicit Idle(bool neighbours) : neighbours_(neighbours) {}
  bool needs_neighbours() const override { return neighbours_; }
  void row(const SheetWindow&, int, int, std::span<Sums>) const override {}

 private:
  bool neighbours_;
};

TEST(FrameSweep, WithoutStagesItIsTheBandSweep) {
  int compared = 0;
  for (const double width : {0.3, 1.0, 40.0}) {
    for (const auto opacity : {SlabOpacity::Additive, SlabOpacity::Exponential}) {
      Lattice lattice = view();
      lattice.slab_width = width;
      lattice.slab_opacity = opacity;
      const scene::Scene scene = make_scene(lattice);
      const std::vector<scene::Splat> splats = scene::collect_splats(scene);
      const WholeSplats whole(scene::axis_sheet_count(scene));
      const KernelSlices sliced = slices(scene);
      for (const SheetAssignment* assignment : std::initializer_list<const SheetAssignment*>{&whole, &sliced}) {
        const Image bands = composite_sheets(scene, splats, {}, *assignment);
        ASSERT_GT(max_opacity(bands), 0.5);
        EXPECT_EQ(bands, sweep_frame(scene, splats, {}, *assignment, {}));
        for (const bool neighbours : {false, true}) {
          const Idle idle(neighbours);
          EXPECT_EQ(bands, sweep_frame(scene, splats, {}, *assignment, {.sheet_stages = {&idle, &idle}}));
        }
        compared += 3;
      }
    }
  }
  figure("frame_sweep_images_equal_to_band_sweep", compared, "more than 0, bit for bit");
}

TEST(FrameSweep, ShapedFootprintsToo) {
  Lattice lattice = view();
  lattice.pixels_per_mm = 0.8;
  scene::Scene scene = make_scene(lattice);
  scene.description.footprint = {scene::FootprintShape::Ellipse, true};
  scene.description.motion = {{3.0, -2.0, 1.0}, 10.0};
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const Image bands = composite_sheets(scene, splats, {}, slices(scene));
  ASSERT_GT(max_opacity(bands), 0.5);
  const Idle idle(true);
  EXPECT_EQ(bands, sweep_frame(scene, splats, {}, slices(scene), {.sheet_stages = {&idle}}));
}

/// The mean of the six neighbours, two of them in other sheets; reads beyond its own rows and sheet.
class Neighbours final : public SheetStage {
 public:
  bool needs_neighbours() const override { return true; }
  int margin() const override { return 1; }
  Run extent(const SheetWindow& window, int, Run) const override { return {0, window.here.width()}; }
  void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const override {
    const Rows rows = window.here.rows();
    for (int i = 0; i < static_cast<int>(pixels.size()); ++i) {
      const int x = begin + i;
      const int left = std::max(x - 1, 0), right = std::min(x + 1, window.here.width() - 1);
      const int up = std::max(y - 1, rows.first), down = std::min(y + 1, rows.end - 1);
      for (int c = 0; c < 4; ++c) {
        pixels[i][c] = (window.here.row(y)[left][c] + window.here.row(y)[right][c] + window.here.row(up)[x][c] +
                        window.here.row(down)[x][c] + window.before.row(y)[x][c] + window.behind.row(y)[x][c]) /
                       6.0;
      }
    }
  }
};

/// The mean of a row and the next.
class TwoRows final : public LayerFilter {
 public:
  bool leaves(int sheet) const override { return sheet % 3 == 0; }
  int margin() const override { return 1; }
  Run extent(int, const LayerFrame& in, int) const override { return {0, in.width}; }
  void row(int, const LayerFrame& in, int y, int begin, std::span<Layer> out) const override {
    const int below = std::min<int>(y + 1, static_cast<int>(in.runs.size()) - 1);
    for (int i = 0; i < static_cast<int>(out.size()); ++i) {
      out[i] = {};
      for (const int from : {y, below}) {
        const Run run = in.runs[from];
        if (begin + i < run.begin || begin + i >= run.end) continue;
        const Layer& layer = in.row(from)[begin + i];
        out[i].red += 0.5 * layer.red, out[i].green += 0.5 * layer.green, out[i].blue += 0.5 * layer.blue;
        out[i].alpha += 0.5 * layer.alpha;
      }
    }
  }
};

TEST(FrameSweep, ThreadsDoNotChangeABit) {
  const scene::Scene scene = make_scene(view());
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const Neighbours neighbours;
  const TwoRows rows;
  const FrameStages stages{.sheet_stages = {&neighbours}, .filter = &rows};
  const Image one = sweep_frame(scene, splats, {1, {}}, slices(scene), stages);
  ASSERT_GT(max_opacity(one), 0.5);
  ASSERT_NE(one, composite_sheets(scene, splats, {}, slices(scene)));
  for (const int threads : {2, 3, 0}) {
    EXPECT_EQ(one, sweep_frame(scene, splats, {threads, {}}, slices(scene), stages)) << threads;
  }
  std::printf("3 comparisons of %zu values, bit for bit\n", one.data.size());
}

/// The total of every row of every sheet, by the role that the window shows it in.
class Record final : public SheetStage {
 public:
  bool needs_neighbours() const override { return true; }
  Run extent(const SheetWindow& window, int y, Run) const override {
    const auto total = [y](const Sheet& sheet) {
      double sum = 0.0;
      for (int x = 0; x < sheet.width(); ++x) sum += sheet.row(y)[x][3];
      return sum;
    };
    const auto n = static_cast<std::size_t>(window.number);
    before[n] += total(window.before), here[n] += total(window.here), behind[n] += total(window.behind);
    return {};
  }
  void row(const SheetWindow&, int, int, std::span<Sums>) const override {}
  mutable std::vector<double> before, here, behind;
};

// The window shows the same sheet in three roles, once each.
TEST(FrameSweep, TheWindowShowsEverySheetInThreeRoles) {
  Record record;
  const scene::Scene scene = make_scene(view());
  const auto sheets = static_cast<std::size_t>(slices(scene).sheets());
  record.before = record.here = record.behind = std::vector<double>(sheets);
  const Image image =
      sweep_frame(scene, scene::collect_splats(scene), {1, {}}, slices(scene), {.sheet_stages = {&record}});
  EXPECT_EQ(max_opacity(image), 0.0);  // an empty extent composites nothing
  EXPECT_EQ(record.before.front(), 0.0);
  EXPECT_EQ(record.behind.back(), 0.0);
  int filled = 0;
  for (std::size_t s = 0; s + 1 < sheets; ++s) {
    EXPECT_EQ(record.here[s], record.before[s + 1]) << s;
    EXPECT_EQ(record.here[s + 1], record.behind[s]) << s;
    filled += record.here[s] > 0.0;
  }
  figure("sheets_seen_in_three_roles", filled, "more than 10");
  EXPECT_GT(filled, 10);
}

/// Shows the splats of even place in each sheet only, or all; checks the window's calls.
class Books final : public Occlusion {
 public:
  Books(const scene::Scene& scene, const std::vector<scene::Splat>& splats, bool half)
      : half_(half), by_sheet_(static_cast<std::size_t>(slices(scene).sheets())) {
    const Projector project(scene);
    for (const scene::Splat& splat : splats) {
      const ProjectedSplat projected = project(splat);
      by_sheet_[static_cast<std::size_t>(slices(scene).first(projected))].push_back(projected);
    }
  }
  std::span<const ProjectedSplat> visible(int sheet, int margin) override {
    EXPECT_EQ(sheet, sheets++);
    EXPECT_EQ(margin, expected_margin);
    EXPECT_EQ(pictures, std::max(0, sheet - lag));
    shown_.clear();
    const auto& all = by_sheet_[static_cast<std::size_t>(sheet)];
    for (std::size_t i = 0; i < all.size(); i += half_ ? 2 : 1) shown_.push_back(all[i]);
    shown += shown_.size(), asked += all.size();
    return shown_;
  }
  void composited(std::span<const FrontToBack> picture, std::span<const Run> changed) override {
    ++pictures;
    before_.resize(picture.size());
    const std::size_t width = picture.size() / changed.size();
    for (std::size_t i = 0; i < picture.size(); ++i) {
      EXPECT_LE(picture[i].transmittance, before_[i].transmittance);
      const Run run = changed[i / width];
      const int x = static_cast<int>(i % width);
      const bool reported = x >= run.begin && x < run.end;
      ASSERT_TRUE(reported || picture[i].transmittance == before_[i].transmittance) << i;
      changes += picture[i].transmittance != before_[i].transmittance;
      before_[i] = picture[i];
    }
  }
  int lag = 0, expected_margin = 0;
  int sheets = 0, pictures = 0;
  std::size_t shown = 0, asked = 0, changes = 0;

 private:
  bool half_;
  std::vector<std::vector<ProjectedSplat>> by_sheet_;
  std::vector<ProjectedSplat> shown_;
  std::vector<FrontToBack> before_;
};

TEST(FrameSweep, SplatsTheVisibleAndReportsChanges) {
  const scene::Scene scene = make_scene(view());
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  Books all(scene, splats, false);
  EXPECT_EQ(composite_sheets(scene, splats, {}, slices(scene)),
            sweep_frame(scene, splats, {}, slices(scene), {.occlusion = &all}));
  EXPECT_EQ(all.sheets, slices(scene).sheets());
  EXPECT_EQ(all.pictures, all.sheets);
  EXPECT_EQ(all.shown, splats.size());
  figure("pixels_changed_by_sheets", static_cast<double>(all.changes), "all of them reported");
  ASSERT_GT(all.changes, 10000u);

  Books half(scene, splats, true);
  const Image hidden = sweep_frame(scene, splats, {}, slices(scene), {.occlusion = &half});
  EXPECT_LT(max_opacity(hidden), max_opacity(composite_sheets(scene, splats, {}, slices(scene))));
  figure("splats_shown", static_cast<double>(half.shown), "about half of those asked about");
  EXPECT_NEAR(static_cast<double>(half.shown), 0.5 * static_cast<double>(half.asked), 0.5 * half.sheets);

  const Neighbours neighbours;
  const TwoRows filter;
  Books late(scene, splats, false);
  late.lag = 1;
  late.expected_margin = 2;
  const FrameStages around{.sheet_stages = {&neighbours}, .filter = &filter};
  FrameStages watched = around;
  watched.occlusion = &late;
  EXPECT_EQ(sweep_frame(scene, splats, {}, slices(scene), around),
            sweep_frame(scene, splats, {}, slices(scene), watched));
  EXPECT_EQ(late.sheets, slices(scene).sheets());
}

TEST(FrameSweep, AFrozenPixelNoLongerChanges) {
  Lattice lattice = view();
  lattice.optical_depth = 2.0;
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const Image plain = sweep_frame(scene, splats, {}, slices(scene), {});
  constexpr double kThreshold = 0.05;
  const Image frozen = sweep_frame(scene, splats, {}, slices(scene), {.freeze_below = kThreshold});
  int differing = 0;
  for (std::size_t i = 3; i < plain.data.size(); i += 4) {
    if (frozen.data[i] == plain.data[i]) continue;
    ++differing;
    ASSERT_GT(frozen.data[i], 1.0 - kThreshold);
    ASSERT_GT(plain.data[i], frozen.data[i]);
    ASSERT_LE(plain.data[i - 1] - frozen.data[i - 1], kThreshold);
  }
  figure("frozen_pixels", differing, "more than 100");
  EXPECT_GT(differing, 100);
}

TEST(FrameSweep, ProgressEndsOnce) {
  const scene::Scene scene = make_scene(view());
  const Idle idle(true);
  std::size_t last = 0;
  int completions = 0;
  const Progress progress = [&](std::size_t done, std::size_t total) {
    EXPECT_GT(done, last);
    last = done;
    completions += done == total;
  };
  sweep_frame(scene, scene::collect_splats(scene), {0, progress}, slices(scene), {.sheet_stages = {&idle}});
  EXPECT_EQ(completions, 1);
}

TEST(FrameSweep, RefusesMoreSheetsThanMemoryHolds) {
  Lattice lattice = view();
  lattice.slab_width = 0.01;
  lattice.width = lattice.height = 2048;
  const scene::Scene scene = make_scene(lattice);
  try {
    sweep_frame(scene, {}, {}, slices(scene), {});
    FAIL() << "not refused";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    EXPECT_STREQ(
        error.what(),
        "402 sheets of 2048x2048 pixels must be in memory at once (expected at most 4 GB, got 54.0 GB); use a larger "
        "slab width or a smaller image");
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
