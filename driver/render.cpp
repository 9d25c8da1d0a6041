#include "driver/render.hpp"

#include <atomic>
#include <cmath>
#include <optional>

#include "base/parallel/parallel.hpp"
#include "cmodel/fast/tile_unit.hpp"
#include "cmodel/model.hpp"
#include "driver/compile.hpp"
#include "driver/frame_sink.hpp"

namespace fastsplat::driver {

namespace {

/// One tile's result besides its pixels.
struct TileResult {
  cmodel::Counters counters;
  TileReport report;
  UnitReport units;
};

TileResult draw_plain(const CompiledFrame& compiled, int tile, cmodel::PixelSink& pixels) {
  cmodel::Model device(compiled.config(), cmodel::StreamScope::Subset, pixels);
  device.consume(compiled.preamble());
  TileResult out;
  out.report = compiled.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
  device.finish();
  out.counters = device.counters();
  out.units.plain = 1;
  return out;
}

template <class Word>
TileResult draw_fast(const CompiledFrame& compiled, const cmodel::fast::FrameTables& tables, int tile,
                     cmodel::PixelSink& pixels) {
  cmodel::fast::TileUnit<Word> unit(tables, pixels);
  TileResult out;
  out.report = compiled.draw_tile(tile, unit);
  if (!unit.sound()) {
    out = draw_plain(compiled, tile, pixels);
    out.units.redone = 1;
    return out;
  }
  out.counters = unit.counters();
  out.units = {.fast = 1, .hidden_splats = unit.hidden_splats()};
  return out;
}

UnitReport& operator+=(UnitReport& report, const UnitReport& tile) {
  report.fast += tile.fast;
  report.plain += tile.plain;
  report.redone += tile.redone;
  report.hidden_splats += tile.hidden_splats;
  return report;
}

}  // namespace

DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options) {
  const CompiledFrame compiled(scene, config, options.threads);
  const char* why_plain = nullptr;
  const auto tables = options.unit == Unit::Fast ? cmodel::fast::frame_tables(config, compiled.preamble(), &why_plain)
                                                 : std::optional<cmodel::fast::FrameTables>{};
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  std::vector<TileResult> results(tiles);
  std::atomic<std::size_t> done{0};

  // Tiles are independent: each has a device of its own, as several chips would.
  parallel_for(compiled.work(), options.threads, [&](std::size_t number) {
    const int tile = static_cast<int>(number);
    results[number] = !tables                    ? draw_plain(compiled, tile, frame)
                      : tables->jobs.plan.narrow ? draw_fast<std::uint16_t>(compiled, *tables, tile, frame)
                                                 : draw_fast<std::uint32_t>(compiled, *tables, tile, frame);
    if (options.progress) options.progress(done.fetch_add(1) + 1, tiles);
  });

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
  for (std::size_t i = 0; i < frame.words.size(); ++i) {
    image.data[i] = static_cast<float>(std::ldexp(static_cast<double>(frame.words[i]), -frame.frac_bits));
  }
  return image;
}

}  // namespace fastsplat::driver
