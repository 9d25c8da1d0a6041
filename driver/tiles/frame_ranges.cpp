// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/frame_ranges.hpp"

#include <mutex>

#include "base/parallel/parallel.hpp"
#include "cmodel/model.hpp"
#include "cmodel/stream/device.hpp"
#include "driver/tiles/compile.hpp"

namespace fastsplat::driver {

FrameRanges frame_ranges(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options) {
  const CompiledFrame compiled(scene, config, options.threads);
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  FrameRanges out;
  out.report = compiled.report();
  std::mutex mutex;
  std::size_t done = 0;
  // Counts, integer sums, extremes and bitwise ORs are merged, so the order does not matter.
  parallel_for(compiled.work(), options.threads, [&](std::size_t number) {
    cmodel::NullPixels nowhere;
    cmodel::Ranges ranges;
    cmodel::Model device(config, cmodel::StreamScope::Subset, nowhere, nullptr, &ranges);
    device.consume(compiled.preamble());
    const TileReport report = compiled.emit_tile(static_cast<int>(number),
                                                 [&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
    device.finish();
    const std::lock_guard lock(mutex);
    out.ranges += ranges;
    out.counters += device.counters();
    out.report += report;
    if (options.progress) options.progress(++done, tiles);
  });
  return out;
}

}  // namespace fastsplat::driver
