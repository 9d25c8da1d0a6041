#include "driver/render.hpp"

#include <atomic>
#include <cmath>

#include "base/parallel/parallel.hpp"
#include "cmodel/model.hpp"
#include "driver/compile.hpp"
#include "driver/frame_sink.hpp"

namespace fastsplat::driver {

DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options) {
  const CompiledFrame compiled(scene, config);
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  DeviceRender out;
  out.report = compiled.report();
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  std::vector<cmodel::Counters> counters(tiles);
  std::vector<TileReport> reports(tiles);
  std::atomic<std::size_t> done{0};

  // Tiles are independent: each has a device of its own, as several chips would.
  parallel_for(tiles, options.threads, [&](std::size_t tile) {
    cmodel::Model device(config, cmodel::StreamScope::Subset, frame);
    device.consume(compiled.preamble());
    reports[tile] =
        compiled.emit_tile(static_cast<int>(tile), [&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
    device.finish();
    counters[tile] = device.counters();
    if (options.progress) options.progress(done.fetch_add(1) + 1, tiles);
  });

  for (std::size_t tile = 0; tile < tiles; ++tile) {
    out.counters += counters[tile];
    out.report += reports[tile];
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
