#include "driver/compile.hpp"

#include <algorithm>
#include <cassert>

#include "cmodel/records.hpp"
#include "cmodel/snap.hpp"
#include "cmodel/window_geometry.hpp"
#include "driver/projection.hpp"
#include "driver/tables.hpp"
#include "scene/capability.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {
namespace {

cmodel::Mode mode_of(const scene::SceneDescription& description) {
  if (description.method == scene::Method::XRay) return cmodel::Mode::Sum;
  return description.slab_opacity == scene::SlabOpacity::Exponential ? cmodel::Mode::Exponential
                                                                     : cmodel::Mode::Additive;
}

const cmodel::Config& checked(const scene::Scene& scene, const cmodel::Config& device) {
  scene::check_capability(scene, offers(device));
  return device;
}

/// The device takes sheets, whatever the method that makes them.
scene::SheetPlan plan_for_device(const scene::Scene& scene) {
  const scene::SheetPlan plan = scene::sheet_plan(scene);
  assert(plan.use != scene::SheetUse::None && "refused by check_capability");
  return plan;
}

Slices make_slices(const cmodel::Config& config, const scene::Scene& scene, const scene::SheetPlan& plan) {
  const bool sliced = plan.use == scene::SheetUse::Sliced;
  return Slices(config, scene.kernel, sliced ? plan.slabs.width : 1.0, sliced ? plan.slabs.count : 1);
}

/// The snapped window of a splat in image pixels. The image may be larger than a tile, so positions get room;
/// the tile's origin is a whole number of pixels, so the window is the one the device finds.
class Windows {
 public:
  Windows(const cmodel::Config& config, const RadiusSets& sets) : wide_(config), sets_(sets) {
    wide_.position_int_bits = 30 - config.position_frac_bits;
  }
  Extent operator()(const QuantisedSplat& splat) const {
    const std::uint32_t rho = sets_.rho(splat.set);
    const auto extent = static_cast<std::int32_t>(cmodel::window_geometry(wide_, rho).extent);
    const std::int32_t x0 = cmodel::snap(wide_, splat.x, rho).origin, y0 = cmodel::snap(wide_, splat.y, rho).origin;
    return {x0, x0 + extent, y0, y0 + extent};
  }

 private:
  cmodel::Config wide_;
  const RadiusSets& sets_;
};

/// Collects beats and hands them on in blocks.
class BlockSink {
 public:
  explicit BlockSink(const cmodel::BeatSink& sink) : sink_(sink) { beats_.reserve(kBlock + 64); }
  void put(const cmodel::Record& record) { append(beats_, record); }
  void put(const cmodel::SplatRecord& splat) {
    beats_.push_back(to_beat(splat));
    if (beats_.size() >= kBlock) flush();
  }
  void flush() {
    sink_(beats_);
    beats_.clear();
  }

 private:
  static constexpr std::size_t kBlock = 4096;
  const cmodel::BeatSink& sink_;
  std::vector<cmodel::Beat> beats_;
};

}  // namespace

struct CompiledFrame::State {
  cmodel::Config config;
  cmodel::Mode mode;
  scene::SheetPlan plan;
  Slices slices;
  Projected projected;
  TileGrid grid;
  TileBins bins;
  int reach = 0;  ///< a splat reaches at most this many sheets beyond its first
  std::vector<cmodel::Beat> preamble;

  State(const scene::Scene& scene, const cmodel::Config& device)
      : config(checked(scene, device)),
        mode(mode_of(scene.description)),
        plan(plan_for_device(scene)),
        slices(make_slices(device, scene, plan)),
        projected(project(scene, device, slices, plan)),
        grid(device, scene.description.width, scene.description.height),
        bins(make_bins()) {
    if (plan.use == scene::SheetUse::Sliced) {
      for (const auto& splat : projected.splats)
        reach = std::max(reach, slices.last(splat.depth) - slices.first(splat.depth));
    }
    make_preamble(scene);
  }

  int first_sheet(const QuantisedSplat& splat) const {
    return plan.use == scene::SheetUse::Sliced ? slices.first(splat.depth) : splat.depth;
  }

  TileBins make_bins() const {
    const Windows windows(config, projected.sets);
    const auto& splats = projected.splats;
    return TileBins(
        grid, plan.slabs.count, splats.size(), [&](std::size_t i) { return windows(splats[i]); },
        [&](std::size_t i) { return first_sheet(splats[i]); });
  }

  void make_preamble(const scene::Scene& scene) {
    cmodel::append(preamble, cmodel::BeginFrame{cmodel::config_hash(config), grid.image_width, grid.image_height,
                                                static_cast<std::uint32_t>(grid.count())});
    cmodel::append(preamble, radial_table(config, scene.kernel));
    cmodel::append(preamble, factor_table(config));
    for (std::uint32_t set = 0; set < projected.sets.size(); ++set) {
      cmodel::append(preamble, rlut_table(config, set, projected.sets.radius(set), projected.sets.base(set)));
    }
  }

  /// Records of one sheet of one tile; begin_sheet only when there is something to say.
  std::uint32_t emit_sheet(int tile, int sheet, std::uint32_t& tag, BlockSink& out, TileReport& report) const {
    const std::int32_t x0 = grid.x(tile) * (1 << config.position_frac_bits),
                       y0 = grid.y(tile) * (1 << config.position_frac_bits);
    std::uint32_t records = 0;
    for (int from = std::max(0, sheet - reach); from <= sheet; ++from) {
      for (const std::uint32_t number : bins.bin(tile, from)) {
        const QuantisedSplat& splat = projected.splats[number];
        const Share share = plan.use == scene::SheetUse::Sliced ? slices.share(splat.words, splat.depth, sheet)
                                                                : slices.whole(splat.words);
        if (share.empty()) continue;
        if (records == 0) out.put(cmodel::BeginSheet{static_cast<std::uint32_t>(sheet)});
        report.saturated_records += share.saturated ? 1 : 0;
        out.put(cmodel::SplatRecord{
            .set = splat.set, .tag = tag++, .x = splat.x - x0, .y = splat.y - y0, .colour = share.words});
        ++records;
      }
    }
    return records;
  }
};

scene::Offers offers(const cmodel::Config&) {
  using scene::Method, scene::only;
  return {"device", only(Method::ImageAligned) | only(Method::AxisAligned) | only(Method::XRay), 0u};
}

CompiledFrame::CompiledFrame(const scene::Scene& scene, const cmodel::Config& config)
    : state_(std::make_unique<const State>(scene, config)) {}
CompiledFrame::~CompiledFrame() = default;

const cmodel::Config& CompiledFrame::config() const { return state_->config; }
const TileGrid& CompiledFrame::grid() const { return state_->grid; }
std::span<const cmodel::Beat> CompiledFrame::preamble() const { return state_->preamble; }

TileReport CompiledFrame::emit_tile(int tile, const cmodel::BeatSink& sink) const {
  const State& s = *state_;
  BlockSink out(sink);
  out.put(cmodel::BeginTile{s.mode, static_cast<std::uint32_t>(tile), s.grid.x(tile), s.grid.y(tile),
                            s.grid.width(tile), s.grid.height(tile)});
  TileReport report;
  std::uint32_t tag = 0;
  for (int sheet = 0; sheet < s.plan.slabs.count; ++sheet) {
    const std::uint32_t records = s.emit_sheet(tile, sheet, tag, out, report);
    if (records == 0) continue;
    out.put(cmodel::EndSheet{static_cast<std::uint32_t>(sheet), records});
    ++report.sheets;
    report.splat_records += records;
  }
  out.put(cmodel::EndTile{static_cast<std::uint32_t>(tile), static_cast<std::uint32_t>(report.sheets)});
  out.flush();
  return report;
}

DriverReport CompiledFrame::emit(const cmodel::BeatSink& sink, const Progress& progress) const {
  DriverReport out = report();
  sink(preamble());
  for (int tile = 0; tile < grid().count(); ++tile) {
    out += emit_tile(tile, sink);
    if (progress) progress(static_cast<std::size_t>(tile) + 1, out.tiles);
  }
  return out;
}

DriverReport& operator+=(DriverReport& report, const TileReport& tile) {
  report.splat_records += tile.splat_records;
  report.saturated_records += tile.saturated_records;
  report.sheets += tile.sheets;
  return report;
}

DriverReport CompiledFrame::report() const {
  return {.voxels = state_->projected.voxels,
          .tiles = static_cast<std::uint64_t>(state_->grid.count()),
          .saturated_voxels = state_->projected.saturated,
          .vanished_voxels = state_->projected.vanished};
}

}  // namespace fastsplat::driver
