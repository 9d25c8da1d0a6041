// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/run_device.hpp"

#include "driver/tiles/compile.hpp"
#include "driver/tiles/frame_sink.hpp"

namespace fastsplat::driver {

DeviceFrame run_device(const cmodel::BeatSource& source, const TileGrid& grid, const cmodel::Config& config,
                       const DeviceFactory& make, const std::function<void(cmodel::Device&)>& finished) {
  FrameSink frame(config, grid.image_width, grid.image_height);
  const auto device = make(frame);
  source([&](std::span<const cmodel::Beat> beats) { device->consume(beats); });
  device->finish();
  DeviceFrame out{.frame = frame.take(), .counters = device->counters()};
  if (finished) finished(*device);
  return out;
}

DeviceRender run_device(const scene::Scene& scene, const cmodel::Config& config, const DeviceFactory& make,
                        const RenderOptions& options, const std::function<void(cmodel::Device&)>& finished) {
  const CompiledFrame compiled(scene, config);
  DeviceRender out;
  const cmodel::BeatSource source = [&](const cmodel::BeatSink& sink) {
    out.report = compiled.emit(sink, options.progress);
  };
  auto [frame, counters] = run_device(source, compiled.grid(), config, make, finished);
  out.frame = std::move(frame);
  out.counters = counters;
  return out;
}

}  // namespace fastsplat::driver
