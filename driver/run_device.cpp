#include "driver/run_device.hpp"

#include "driver/compile.hpp"
#include "driver/frame_sink.hpp"

namespace fastsplat::driver {

DeviceRender run_device(const scene::Scene& scene, const cmodel::Config& config, const DeviceFactory& make,
                        const RenderOptions& options, const std::function<void(cmodel::Device&)>& finished) {
  const CompiledFrame compiled(scene, config);
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  const auto device = make(frame);
  DeviceRender out;
  out.report = compiled.report();
  out.report.tiles = static_cast<std::uint64_t>(compiled.grid().count());
  device->consume(compiled.preamble());
  for (int tile = 0; tile < compiled.grid().count(); ++tile) {
    const TileReport part =
        compiled.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) { device->consume(beats); });
    out.report.splat_records += part.splat_records;
    out.report.saturated_records += part.saturated_records;
    out.report.sheets += part.sheets;
    if (options.progress) options.progress(static_cast<std::size_t>(tile) + 1, out.report.tiles);
  }
  device->finish();
  out.counters = device->counters();
  out.frame = frame.take();
  if (finished) finished(*device);
  return out;
}

}  // namespace fastsplat::driver
