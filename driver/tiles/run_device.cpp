// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/run_device.hpp"

#include "driver/tiles/compile.hpp"
#include "driver/tiles/frame_sink.hpp"

namespace fastsplat::driver {

DeviceRender run_device(const scene::Scene& scene, const cmodel::Config& config, const DeviceFactory& make,
                        const RenderOptions& options, const std::function<void(cmodel::Device&)>& finished) {
  const CompiledFrame compiled(scene, config);
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  const auto device = make(frame);
  DeviceRender out;
  out.report = compiled.emit([&](std::span<const cmodel::Beat> beats) { device->consume(beats); }, options.progress);
  device->finish();
  out.counters = device->counters();
  out.frame = frame.take();
  if (finished) finished(*device);
  return out;
}

}  // namespace fastsplat::driver
