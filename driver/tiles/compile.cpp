// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/compile.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/pattern_tables.hpp"
#include "driver/tables/tables.hpp"
#include "driver/tiles/beat_writer.hpp"
#include "driver/tiles/compiled_state.hpp"
#include "scene/capability.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {
namespace {

cmodel::Mode mode_of(const scene::SceneDescription& description) {
  if (description.method == scene::Method::XRay) return cmodel::Mode::Sum;
  const bool exponential = description.slab_opacity == scene::SlabOpacity::Exponential;
  if (holds_densities(description))
    return exponential ? cmodel::Mode::DensityExponential : cmodel::Mode::DensityAdditive;
  if (every_sample(description)) return exponential ? cmodel::Mode::SampleExponential : cmodel::Mode::SampleAdditive;
  return exponential ? cmodel::Mode::Exponential : cmodel::Mode::Additive;
}

const cmodel::Config& checked(const scene::Scene& scene, const cmodel::Config& device) {
  scene::check_capability(scene, offers(device));
  check_densities(scene);
  return device;
}

}  // namespace

scene::SheetPlan plan_for_device(const scene::Scene& scene) {
  if (every_sample(scene.description)) return {scene::SheetUse::OneSheet, {.count = 1}};
  const scene::SheetPlan plan = scene::sheet_plan(scene);
  assert(plan.use != scene::SheetUse::None && "refused by check_capability");
  return plan;
}

CompiledFrame::State::State(const scene::Scene& scene, const cmodel::Config& device, int threads, int band_rows)
    : config(checked(scene, device)),
      mode(mode_of(scene.description)),
      plan(plan_for_device(scene)),
      slices(frame_slices(device, scene, plan)),
      projected(project(scene, device, slices, plan, threads)),
      grid(device, scene.description.width, scene.description.height, holds_densities(scene.description) ? 1 : 0),
      bands(grid, band_rows > 0 && !device.culls() && !holds_densities(scene.description)
                      ? (band_rows + device.lanes - 1) / device.lanes * device.lanes
                      : device.tile_height),
      windows(device, projected.sets),
      cells(make_cells()),
      bins(make_bins(threads)) {
  if (sliced()) reach = shaped() ? slices.reach(slices.growth(projected.least_shrink)) : slices.reach();
  make_preamble(scene, threads);
}

Cells CompiledFrame::State::make_cells() const {
  return in_sets() ? Cells(grid, cmodel::cull_cell_pixels(config)) : Cells();
}

TileBins CompiledFrame::State::make_bins(int threads) const {
  const auto& splats = projected.splats;
  return TileBins(
      grid, bands, cells, plan.slabs.count, splats.size(), threads,
      [&](std::size_t i) {
        return widened(
            splats[i].set == kOwnShape ? windows(splats[i], projected.ellipses[i].shape) : windows(splats[i]), halo());
      },
      [&](std::size_t i) { return first_sheet(static_cast<std::uint32_t>(i)); });
}

void CompiledFrame::State::make_preamble(const scene::Scene& scene, int threads) {
  cmodel::append(preamble, cmodel::BeginFrame{cmodel::config_hash(config), grid.image_width, grid.image_height,
                                              static_cast<std::uint32_t>(grid.count())});
  cmodel::append(preamble, radial_table(config, scene.kernel));
  cmodel::append(preamble, factor_table(config));
  for (std::uint32_t set = 0; set < projected.sets.size(); ++set) {
    cmodel::append(preamble, set_table(config, scene.kernel, set, projected.sets.radius(set), projected.sets.base(set),
                                       {.textures = &projected.textures, .number = projected.sets.picture(set)}));
  }
  const auto append_all = [this](std::vector<cmodel::LoadTable> tables) {
    for (cmodel::LoadTable& table : tables) cmodel::append(preamble, std::move(table));
  };
  if (holds_densities(scene.description)) append_all(density_tables(config, scene, plan.slabs));
  if (has_pattern(scene.description)) append_all(pattern_tables(config, scene, plan.slabs, threads));
}

std::uint32_t CompiledFrame::State::emit_sheet(int tile, int sheet, std::uint32_t& tag, cmodel::RecordSink& out,
                                               TileReport& report) const {
  const std::int32_t x0 = grid.x(tile) * (1 << config.position_frac_bits),
                     y0 = grid.y(tile) * (1 << config.position_frac_bits);
  std::array<cmodel::SplatRecord, 256> some;
  std::size_t waiting = 0;
  std::uint32_t records = 0;
  std::vector<std::uint32_t> merged;
  for (int from = std::max(0, sheet - reach); from <= sheet; ++from) {
    for (const std::uint32_t number : bins.bin(tile, from, merged)) {
      const QuantisedSplat& splat = projected.splats[number];
      const Share part = share(number, sheet);
      if (part.empty()) continue;
      if (splat.set == kOwnShape) {
        if (waiting > 0) out.splats(std::span(some).first(waiting));
        waiting = 0;
        std::uint32_t more = 0;
        for_each_ellipse(tile, number, part.words, [&](cmodel::EllipseRecord record) {
          if (records + more++ == 0) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
          record.tag = tag++;
          out.ellipses({&record, 1});
        });
        report.saturated_records += part.saturated ? more : 0;
        records += more;
        continue;
      }
      if (records == 0) out.begin_sheet({static_cast<std::uint32_t>(sheet)});
      report.saturated_records += part.saturated ? 1 : 0;
      some[waiting++] = {.set = splat.set, .tag = tag++, .x = splat.x - x0, .y = splat.y - y0, .colour = part.words};
      ++records;
      if (waiting < some.size()) continue;
      out.splats(some);
      waiting = 0;
    }
  }
  if (waiting > 0) out.splats(std::span(some).first(waiting));
  if (records > 0) out.end_sheet({static_cast<std::uint32_t>(sheet), records});
  return records;
}

scene::Offers offers(const cmodel::Config& config) {
  using scene::Method, scene::only;
  scene::Offers out{.engine = "device",
                    .methods = only(Method::ImageAligned) | only(Method::AxisAligned) | only(Method::XRay),
                    .features = 0u,
                    .footprints_fix = "choose a configuration with ellipses, ",
                    .methods_elsewhere = only(Method::Westover),
                    .methods_fix = "set composite.every_sample = 1, ",
                    .densities_fix = "set classify.segment_bits = 9, ",
                    .details_fix = "set index.kind = blit2d and snap.phases = 8, ",
                    .patterns_fix = "set pattern.node_bits = 7, "};
  if (config.has_ellipses()) {
    out.engine = "device with ellipses";
    out.features = static_cast<unsigned>(scene::Feature::Footprints);
  }
  if (config.classifies()) out.features |= static_cast<unsigned>(scene::Feature::Densities);
  if (config.has_patterns()) out.features |= static_cast<unsigned>(scene::Feature::Patterns);
  // Textured footprints have neither mirror images nor a radial table.
  if (config.index() == cmodel::IndexKind::Blit2d &&
      config.index_symmetry == static_cast<int>(cmodel::IndexSymmetry::Off))
    out.features |= static_cast<unsigned>(scene::Feature::Details);
  if (config.composite_every_sample != 0) out.methods |= only(Method::Westover);
  return out;
}

bool every_sample(const scene::SceneDescription& description) { return description.method == scene::Method::Westover; }

CompiledFrame::CompiledFrame(const scene::Scene& scene, const cmodel::Config& config, int threads, int band_rows)
    : state_(std::make_unique<const State>(scene, config, threads, band_rows)) {}
CompiledFrame::~CompiledFrame() = default;

const cmodel::Config& CompiledFrame::config() const { return state_->config; }
const TileGrid& CompiledFrame::grid() const { return state_->grid; }
int CompiledFrame::bands() const { return state_->bands.of_tile(); }
std::span<const cmodel::Beat> CompiledFrame::preamble() const { return state_->preamble; }

TileReport CompiledFrame::emit_tile(int tile, cmodel::RecordSink& sink) const {
  const State& s = *state_;
  sink.begin_tile(s.begin_tile(tile));
  TileReport report;
  std::uint32_t tag = 0;
  for (int sheet = 0; sheet < s.plan.slabs.count; ++sheet) {
    if (s.in_sets()) {
      report.sheets += s.emit_sets(tile, sheet, tag, sink, report) ? 1 : 0;
      continue;
    }
    const std::uint32_t records = s.emit_sheet(tile, sheet, tag, sink, report);
    report.sheets += records > 0 ? 1 : 0;
    report.splat_records += records;
  }
  sink.end_tile({static_cast<std::uint32_t>(tile), static_cast<std::uint32_t>(report.sheets)});
  return report;
}

TileReport CompiledFrame::emit_tile(int tile, const cmodel::BeatSink& sink, const Hides& hides) const {
  BeatWriter beats(sink, hides);
  return emit_tile(tile, beats);
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

std::vector<std::uint64_t> CompiledFrame::work() const {
  std::vector<std::uint64_t> out;
  for (int tile = 0; tile < grid().count(); ++tile) {
    for (int band = 0; band < bands(); ++band) out.push_back(state_->bins.count(tile, band));
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
          .vanished_voxels = state_->projected.vanished,
          .vanished_share = state_->projected.vanished_share,
          .widened_voxels = state_->projected.widened,
          .carried = state_->projected.carried};
}

}  // namespace fastsplat::driver
