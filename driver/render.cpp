#include "driver/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>

#include "cmodel/model.hpp"
#include "driver/compile.hpp"
#include "driver/frame_sink.hpp"

namespace fastsplat::driver {

DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options) {
  const CompiledFrame compiled(scene, config);
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  DeviceRender out;
  out.report = compiled.report();
  out.report.tiles = tiles;
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  std::vector<cmodel::Counters> counters(tiles);
  std::vector<TileReport> reports(tiles);
  std::atomic<std::size_t> done{0};

  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, tiles, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t tile = range.begin(); tile != range.end(); ++tile) {
            // Tiles are independent: each has a device of its own, as several chips would.
            cmodel::Model device(config, cmodel::StreamScope::Subset, frame);
            device.consume(compiled.preamble());
            reports[tile] = compiled.emit_tile(static_cast<int>(tile),
                                               [&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
            device.finish();
            counters[tile] = device.counters();
            if (options.progress) options.progress(done.fetch_add(1) + 1, tiles);
          }
        },
        tbb::simple_partitioner());
  });

  for (std::size_t tile = 0; tile < tiles; ++tile) {
    out.counters += counters[tile];
    out.report.splat_records += reports[tile].splat_records;
    out.report.saturated_records += reports[tile].saturated_records;
    out.report.sheets += reports[tile].sheets;
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
