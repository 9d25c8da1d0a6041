// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/render.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel/parallel.hpp"
#include "cmodel/fast/tile_unit.hpp"
#include "cmodel/model.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tables/pattern_tables.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/frame_sink.hpp"
#include "driver/tiles/picture.hpp"

namespace fastsplat::driver {

namespace {

/// Height of a band, the work unit of a thread, so that few busy tiles keep several threads busy. Taller bands share
/// fewer splats.
constexpr int kBandRows = 64;

/// Called when a tile is done.
using OnTile = std::function<void()>;

/// One tile's result besides its pixels.
struct TileResult {
  cmodel::Counters counters;
  TileReport report;
  UnitReport units;
};

TileResult draw_plain(const CompiledFrame& compiled, int tile, cmodel::PixelSink& pixels,
                      cmodel::Terminations* terminations) {
  cmodel::Model device(compiled.config(), cmodel::StreamScope::Subset, pixels);
  device.note_terminations(terminations);
  device.consume(compiled.preamble());
  TileResult out;
  out.report = compiled.emit_tile(
      tile, [&](std::span<const cmodel::Beat> beats) { device.consume(beats); },
      [&](const cmodel::CullBlock& set) { return device.would_hide(set); });
  device.finish();
  out.counters = device.counters();
  out.units.plain = 1;
  out.units.hidden_splats = device.culls().hidden_splats;
  return out;
}

/// The same for one band; `sound`: no sum can have been cut.
struct BandResult {
  cmodel::Counters counters;
  cmodel::fast::BandReport report;
  std::uint64_t hidden_splats = 0;
  bool sound = true;
};

template <class Word>
BandResult draw_fast(const CompiledFrame& compiled, const cmodel::fast::FrameTables& tables, int tile, int band,
                     cmodel::PixelSink& pixels) {
  cmodel::fast::TileUnit<Word> unit(tables, pixels);
  cmodel::fast::BandReport report = compiled.draw_band(tile, band, unit);
  return {unit.counters(), std::move(report), unit.hidden_splats(), unit.sound()};
}

/// Combines the bands of a tile; nullopt if one of them is not sound.
std::optional<TileResult> whole_tile(std::span<const BandResult> bands) {
  TileResult out;
  std::vector<std::uint8_t> sheets(bands.front().report.sheets.size());
  for (const BandResult& band : bands) {
    if (!band.sound) return std::nullopt;
    out.counters += band.counters;
    out.report.splat_records += band.report.splat_records;
    out.report.saturated_records += band.report.saturated_records;
    out.units.hidden_splats += band.hidden_splats;
    for (std::size_t sheet = 0; sheet < sheets.size(); ++sheet) sheets[sheet] |= band.report.sheets[sheet];
  }
  out.counters.tiles = out.units.fast = 1;
  out.counters.sheets = out.report.sheets = static_cast<std::uint64_t>(std::ranges::count(sheets, 1));
  return out;
}

/// Tiles are independent: each has its own device, as with several chips.
std::vector<TileResult> draw_all_plain(const CompiledFrame& compiled, const RenderOptions& options,
                                       cmodel::PixelSink& pixels, const OnTile& on_tile) {
  std::vector<TileResult> results(static_cast<std::size_t>(compiled.grid().count()));
  const std::vector<std::uint64_t> bands = compiled.work();
  std::vector<std::uint64_t> work(results.size());
  for (std::size_t i = 0; i < bands.size(); ++i) work[i / static_cast<std::size_t>(compiled.bands())] += bands[i];
  parallel_for(work, options.threads, [&](std::size_t tile) {
    results[tile] = draw_plain(compiled, static_cast<int>(tile), pixels, options.terminations);
    on_tile();
  });
  return results;
}

/// Bands are independent, too. The thread that finishes a tile's last band combines them or redraws the tile.
std::vector<TileResult> draw_all_fast(const CompiledFrame& compiled, const cmodel::fast::FrameTables& tables,
                                      int threads, cmodel::PixelSink& pixels, const OnTile& on_tile) {
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  const auto each = static_cast<std::size_t>(compiled.bands());
  std::vector<TileResult> results(tiles);
  std::vector<BandResult> bands(tiles * each);
  std::vector<std::atomic<std::size_t>> ended(tiles);
  parallel_for(compiled.work(), threads, [&](std::size_t number) {
    const std::size_t tile = number / each;
    const int t = static_cast<int>(tile), band = static_cast<int>(number % each);
    bands[number] = tables.plan.narrow ? draw_fast<std::uint16_t>(compiled, tables, t, band, pixels)
                                       : draw_fast<std::uint32_t>(compiled, tables, t, band, pixels);
    if (++ended[tile] < each) return;
    const auto whole = whole_tile(std::span(bands).subspan(tile * each, each));
    results[tile] = whole ? *whole : draw_plain(compiled, t, pixels, tables.terminations);
    if (!whole) results[tile].units.redone = 1;
    on_tile();
  });
  return results;
}

}  // namespace

UnitReport& operator+=(UnitReport& report, const UnitReport& tile) {
  report.fast += tile.fast;
  report.plain += tile.plain;
  report.redone += tile.redone;
  report.hidden_splats += tile.hidden_splats;
  return report;
}

DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options) {
  const char* why_plain = nullptr;
  const bool fast = options.unit == Unit::Fast && cmodel::fast::fast_plan(config, &why_plain);
  const int band_rows = !fast ? 0 : options.band_rows > 0 ? options.band_rows : kBandRows;
  FrameHead head(scene, config, options.threads);
  const cmodel::fast::FrameNeeds needs{.ellipses = draws_ellipses(scene, config),
                                       .samples = every_sample(scene.description),
                                       .tints = has_pattern(scene.description) && !holds_densities(scene.description)};
  auto tables = fast ? cmodel::fast::frame_tables(config, head.preamble, needs, &why_plain)
                     : std::optional<cmodel::fast::FrameTables>{};
  if (tables) tables->terminations = options.terminations;
  if (tables && !options.counters && draws_pictures(scene, head)) {
    auto picture = draw_picture(scene, head, *tables, band_rows, options.threads, options.progress);
    if (picture) {
      return {.frame = std::move(picture->frame),
              .counters = picture->losses,
              .report = picture->report,
              .units = {.vectors = cmodel::fast::vector_target()},
              .counted = false};
    }
    if (options.terminations != nullptr)
      options.terminations->reset(0, 0, head.grid.image_width, head.grid.image_height);
  }
  const CompiledFrame compiled(scene, std::move(head), options.threads, band_rows);
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  std::atomic<std::size_t> done{0};
  const OnTile on_tile = [&] {
    if (options.progress) options.progress(done.fetch_add(1) + 1, static_cast<std::size_t>(compiled.grid().count()));
  };
  const std::vector<TileResult> results = tables ? draw_all_fast(compiled, *tables, options.threads, frame, on_tile)
                                                 : draw_all_plain(compiled, options, frame, on_tile);

  DeviceRender out;
  out.report = compiled.report();
  out.units.vectors = tables ? cmodel::fast::vector_target() : nullptr;
  out.units.why_plain = why_plain;
  for (const TileResult& result : results) {
    out.counters += result.counters;
    out.report += result.report;
    out.units += result.units;
  }
  out.frame = frame.take();
  return out;
}

Image to_image(const cmodel::Frame& frame) {
  Image image(frame.width, frame.height, 4);
  const double unit = std::ldexp(1.0, -frame.frac_bits);
  for (std::size_t i = 0; i < frame.words.size(); ++i) image.data[i] = static_cast<float>(frame.words[i] * unit);
  return image;
}

}  // namespace fastsplat::driver
