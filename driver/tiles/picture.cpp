// SPDX-License-Identifier: Apache-2.0
// Bricks of voxels are opened front to back, each in the first sheet that one of its splats can reach, unless all pixels
// that it can touch are terminated by then.
#include "driver/tiles/picture.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <vector>

#include "base/parallel/parallel.hpp"
#include "cmodel/fast/tile_unit.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tiles/frame_sink.hpp"
#include "driver/tiles/share_kernel.hpp"
#include "driver/tiles/windows.hpp"
#include "scene/splat_store.hpp"

namespace fastsplat::driver {
namespace {

constexpr int kBlocksAcross = 64;  ///< of a band: TileUnit has a bit for each

/// A brick that may have a splat.
struct Brick {
  std::size_t number = 0;  ///< in the store
  glm::ivec3 low{0};       ///< its first voxel
  Extent box{};            ///< holds all pixels that its splats can touch
  int sheet = 0;           ///< no splat of it reaches an earlier one
};

/// What all bands share.
struct Shared {
  const scene::Scene& scene;
  const FrameHead& head;
  const cmodel::fast::FrameTables& tables;
  scene::SplatStore& store;
  scene::VoxelSplats voxels;
  SplatQuantiser quantised;
  CentreRule centres;
  Windows windows;
  std::vector<Brick> bricks;  ///< by sheet
  int width, height;          ///< of a band, pixels
  int reach;                  ///< sheets that a splat may reach behind its first

  Shared(const scene::Scene& of, const FrameHead& frame, const cmodel::fast::FrameTables& loaded,
         scene::SplatStore& kept, int band_rows)
      : scene(of),
        head(frame),
        tables(loaded),
        store(kept),
        voxels(of, scene::SplatKind::Colours, kept.classifier()),
        quantised(of, frame.config, frame.sets, frame.slices, frame.plan, frame.pictures()),
        centres(quantised.centre_rule()),
        windows(frame.config, frame.sets),
        width(std::min(frame.grid.image_width, kBlocksAcross * frame.config.lanes)),
        height((band_rows + frame.config.lanes - 1) / frame.config.lanes * frame.config.lanes),
        reach(frame.sliced() ? frame.slices.reach() : 0) {
    for (std::size_t number = 0; number < store.bricks().size(); ++number) {
      const volume::Brick& brick = store.bricks()[number];
      if (!voxels.transparent(brick.least, brick.greatest)) bricks.push_back(bounded(brick, number));
    }
    std::ranges::stable_sort(bricks, {}, &Brick::sheet);
  }

  int columns() const { return (head.grid.image_width + width - 1) / width; }
  int rows() const { return (head.grid.image_height + height - 1) / height; }
  cmodel::BeginTile band(int number) const {
    const int x = number % columns() * width, y = number / columns() * height;
    return {head.mode, static_cast<std::uint32_t>(number), x, y, std::min(width, head.grid.image_width - x),
            std::min(height, head.grid.image_height - y)};
  }
  /// The band of a splat's centre, which counts it; it may touch others.
  int band_of(const QuantisedSplat& splat) const {
    const int half = (1 << head.config.position_frac_bits) / 2;
    const int x = std::clamp((splat.x + half) >> head.config.position_frac_bits, 0, head.grid.image_width - 1);
    const int y = std::clamp((splat.y + half) >> head.config.position_frac_bits, 0, head.grid.image_height - 1);
    return y / height * columns() + x / width;
  }

 private:
  /// Projected boxes are the hulls of their projected corners, and words are monotonic in what they round.
  Brick bounded(const volume::Brick& brick, std::size_t number) const {
    Brick out{.number = number, .low = brick.low};
    std::array<SplatQuantiser::Placed, 8> corners;
    std::uint32_t widest = 0;
    std::int32_t depth = std::numeric_limits<std::int32_t>::max();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::ivec3 at((i & 1) != 0 ? brick.high.x : brick.low.x, (i & 2) != 0 ? brick.high.y : brick.low.y,
                          (i & 4) != 0 ? brick.high.z : brick.low.z);
      corners[i] = quantised.place(scene.camera.project(scene.volume->position(at.x, at.y, at.z)), voxels.slice(at), {});
      if (head.sets.rho(corners[i].splat.set) > head.sets.rho(widest)) widest = corners[i].splat.set;
      depth = std::min(depth, corners[i].splat.depth);
    }
    // A step and a pixel more: a voxel's position is rounded to float before it is projected.
    out.sheet = head.sliced() ? head.slices.first(depth - 1) : depth;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      corners[i].splat.set = widest;
      const Extent one = windows(corners[i].splat);
      if (i == 0) out.box = one;
      out.box = {std::min(out.box.x0, one.x0), std::max(out.box.x1, one.x1), std::min(out.box.y0, one.y0),
                 std::max(out.box.y1, one.y1), 0};
    }
    out.box = widened(out.box, 1);
    return out;
  }
};

struct VisitedBand {
  DriverReport report;
  double asked = 0.0, lost = 0.0;  ///< of all colour and opacity, and of the splats that vanished
};

/// Draws bands, one after the other.
template <class Word>
class BandPainter {
 public:
  BandPainter(const Shared& shared, cmodel::PixelSink& pixels)
      : shared_(shared),
        unit_(shared.tables, pixels, cmodel::fast::Counts::None),
        waiting_(static_cast<std::size_t>(shared.head.plan.slabs.count)) {}

  /// False if a sum may have been cut.
  bool draw(int number, VisitedBand& result) {
    result_ = &result;
    band_ = shared_.band(number);
    bricks_.clear();
    for (const Brick& brick : shared_.bricks) {
      if (brick.box.x1 > band_.x && brick.box.x0 < band_.x + band_.width && brick.box.y1 > band_.y &&
          brick.box.y0 < band_.y + band_.height)
        bricks_.push_back(&brick);
    }
    unit_.begin_band(band_, true, 0);
    std::size_t next = 0;
    std::uint32_t sheets = 0;
    for (int sheet = 0; sheet < static_cast<int>(waiting_.size()) && unit_.sound(); ++sheet) {
      unit_.begin_sheet({static_cast<std::uint32_t>(sheet)});
      for (; next < bricks_.size() && bricks_[next]->sheet <= sheet; ++next) open(*bricks_[next]);
      bool drawn = false;
      for (int first = std::max(0, sheet - shared_.reach); first <= sheet; ++first)
        drawn = draw_shares(first, sheet) || drawn;
      if (sheet >= shared_.reach) recycle(waiting_[static_cast<std::size_t>(sheet - shared_.reach)]);
      if (!drawn) continue;
      unit_.end_sheet({static_cast<std::uint32_t>(sheet), 0});
      ++sheets;
    }
    for (Splats& splats : waiting_) recycle(splats);
    unit_.end_tile({band_.tile, sheets});
    return unit_.sound();
  }
  const cmodel::Counters& counters() const { return unit_.counters(); }

 private:
  using Splats = std::vector<WaitingSplat>;
  static constexpr std::size_t kRoom = 1024;  ///< splats of a sheet for which memory is taken at once

  /// A brick's splats as words: centres, with room for whole vectors.
  struct Centres {
    std::vector<std::int32_t> x, y, depth;
    std::vector<double> scale;
    void resize(std::size_t count) {
      for (auto* words : {&x, &y, &depth}) words->resize(count + kMoreCentres);
      scale.resize(count + kMoreCentres);
    }
  };
  /// A splat that can be seen.
  struct Seen {
    cmodel::fast::WaitingRecord record;
    std::int32_t depth;
  };

  /// Splats of the brick that can be seen wait for their sheets.
  void open(const Brick& brick) {
    const cmodel::PixelBox box{brick.box.x0 - band_.x, brick.box.y0 - band_.y, brick.box.x1 - band_.x,
                               brick.box.y1 - band_.y};
    if (unit_.terminated(box)) return;
    const scene::BrickSplats& splats = shared_.store.splats(shared_.voxels, brick.number, scratch_);
    centres_.resize(splats.splats.size());
    place_centres(shared_.centres, {splats.row(0), splats.row(1), splats.row(2)}, splats.splats.size(),
                  centres_.x.data(), centres_.y.data(), centres_.depth.data(), centres_.scale.data());
    if (seen_.size() < splats.splats.size()) {
      seen_.resize(splats.splats.size());
      colours_.resize(splats.splats.size());
    }
    std::size_t seen = 0;
    for (std::size_t i = 0; i < splats.splats.size(); ++i) {
      const auto& [splat, at] = splats.splats[i];
      const SplatQuantiser::Placed placed = shared_.quantised.placed(
          centres_.x[i], centres_.y[i], centres_.depth[i], centres_.scale[i],
          shared_.voxels.slice(brick.low + glm::ivec3(at[0], at[1], at[2])), splats.position(i));
      cmodel::SnappedAxis x = shared_.windows.snapped(placed.splat.x, placed.splat.set),
                          y = shared_.windows.snapped(placed.splat.y, placed.splat.set);
      x.origin -= band_.x;
      y.origin -= band_.y;
      cmodel::fast::PlacedFootprint footprint = unit_.place(placed.splat.set, x, y);
      if (footprint.weighted == 0 || unit_.hidden(footprint)) continue;
      footprint.counted = shared_.band_of(placed.splat) == static_cast<int>(band_.tile);
      seen_[seen].record = unit_.record(footprint);
      seen_[seen].depth = placed.splat.depth;
      const glm::vec3 emission = shared_.voxels.emission(splat);
      colours_[seen].material = {emission.x, emission.y, emission.z, splat.extinction};
      colours_[seen].amplitude = placed.amplitude;
      ++seen;
    }
    shared_.quantised.colour(colours_.data(), seen);
    const FrameHead& head = shared_.head;
    for (std::size_t i = 0; i < seen; ++i) {
      const std::int32_t depth = seen_[i].depth;
      if (seen_[i].record.counted) count(colours_[i]);
      if (colours_[i].empty()) continue;  // it vanished
      WaitingSplat& splat = wait(head.sliced() ? head.slices.first(depth) : depth);
      splat.record = seen_[i].record;
      splat.words = colours_[i].words;
      splat.depth = depth;
      splat.last_sheet = head.sliced() ? head.slices.last(depth) : depth;
    }
  }
  /// Draws the shares of the splats that begin in `first` in the sheet. False if there are none.
  bool draw_shares(int first, int sheet) {
    Splats& splats = waiting_[static_cast<std::size_t>(first)];
    std::erase_if(splats,
                  [&](const WaitingSplat& splat) { return splat.last_sheet < sheet || unit_.hidden(splat.record); });
    const Slices& slices = shared_.head.slices;
    if (shares_.size() < splats.size()) shares_.resize(splats.size());
    share_out(shared_.head.sliced() ? slices.cut(sheet) : slices.uncut(), shared_.tables.plan.colour_shift,
              splats.data(), splats.size(), shares_.data());
    bool drawn = false;
    for (std::size_t i = 0; i < splats.size(); ++i) {
      if (shares_[i].empty) continue;
      unit_.add(splats[i].record, shares_[i].words);
      drawn = true;
      if (!splats[i].record.counted) continue;
      ++result_->report.splat_records;
      result_->report.saturated_records += shares_[i].saturated ? 1 : 0;
    }
    return drawn;
  }
  void count(const ColourToRound& one) {
    DriverReport& report = result_->report;
    ++report.voxels;
    result_->asked += one.asked;
    if (!one.empty()) {
      report.saturated_voxels += one.saturated ? 1 : 0;
      return;
    }
    ++report.vanished_voxels;
    result_->lost += one.asked;
  }
  /// A place for a splat that begins in the sheet.
  WaitingSplat& wait(int sheet) {
    Splats& splats = waiting_[static_cast<std::size_t>(sheet)];
    if (splats.capacity() == 0) {
      if (spare_.empty()) spare_.emplace_back().reserve(kRoom);
      splats = std::move(spare_.back());
      spare_.pop_back();
    }
    return splats.emplace_back();
  }
  /// Keeps the memory of a sheet that is done for one to come.
  void recycle(Splats& splats) {
    splats.clear();
    if (splats.capacity() > 0) spare_.push_back(std::move(splats));
    splats = {};
  }

  const Shared& shared_;
  cmodel::BeginTile band_;
  cmodel::fast::TileUnit<Word> unit_;
  std::vector<const Brick*> bricks_;  ///< that meet the band, by sheet
  std::vector<Splats> waiting_;       ///< by their first sheet
  std::vector<Splats> spare_;
  std::vector<SheetColour> shares_;  ///< of the splats being drawn
  scene::BrickSplats scratch_;
  Centres centres_;                     ///< of the brick being opened
  std::vector<Seen> seen_;              ///< its splats that can be seen
  std::vector<ColourToRound> colours_;  ///< theirs
  VisitedBand* result_ = nullptr;
};

/// One painter a thread, so that its memory serves all its bands. Empty if a sum may have been cut.
template <class Word>
std::optional<Picture> draw_bands(const Shared& shared, int threads, const Progress& progress) {
  const int count = shared.columns() * shared.rows();
  const std::size_t workers = std::min(thread_count(threads), static_cast<std::size_t>(count));
  FrameSink frame(shared.head.config, shared.head.grid.image_width, shared.head.grid.image_height);
  std::vector<VisitedBand> results(static_cast<std::size_t>(count));
  std::vector<cmodel::Counters> losses(workers);
  std::atomic<int> next{0}, done{0};
  std::atomic<bool> sound{true};
  parallel_for(workers, threads, [&](std::size_t worker) {
    BandPainter<Word> painter(shared, frame);
    for (int band = next++; band < count && sound; band = next++) {
      if (!painter.draw(band, results[static_cast<std::size_t>(band)])) sound = false;
      if (progress) progress(static_cast<std::size_t>(++done), results.size());
    }
    losses[worker] = painter.counters();
  });
  if (!sound) return std::nullopt;
  Picture out{.frame = frame.take(), .losses = {}, .report = {}};
  for (const cmodel::Counters& one : losses) out.losses += one;
  double asked = 0.0, lost = 0.0;
  for (const VisitedBand& one : results) {
    out.report.voxels += one.report.voxels;
    out.report.splat_records += one.report.splat_records;
    out.report.saturated_voxels += one.report.saturated_voxels;
    out.report.saturated_records += one.report.saturated_records;
    out.report.vanished_voxels += one.report.vanished_voxels;
    asked += one.asked;
    lost += one.lost;
  }
  out.report.vanished_share = asked == 0.0 ? 0.0 : lost / asked;
  return out;
}

}  // namespace

bool draws_pictures(const scene::Scene& scene, const FrameHead& head) {
  return !cmodel::every_sample(head.mode) && !cmodel::holds_densities(head.mode) &&
         !draws_ellipses(scene, head.config) && !carries(scene.description.method, head.config);
}

std::optional<Picture> draw_picture(const scene::Scene& scene, const FrameHead& head,
                                    const cmodel::fast::FrameTables& tables, int band_rows, int threads,
                                    const Progress& progress) {
  scene::SplatStore nothing_kept(0);
  scene::SplatStore& store = scene.store ? *scene.store : nothing_kept;
  store.open(scene);
  const Shared shared(scene, head, tables, store, band_rows);
  return tables.plan.narrow ? draw_bands<std::uint16_t>(shared, threads, progress)
                            : draw_bands<std::uint32_t>(shared, threads, progress);
}

}  // namespace fastsplat::driver
