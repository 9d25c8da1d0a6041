// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/cull_log.hpp"

#include <mutex>
#include <utility>

#include "base/parallel/parallel.hpp"
#include "cmodel/model.hpp"

namespace fastsplat::driver {

CullRun run_culls(const CompiledFrame& compiled, int threads, const Progress& progress) {
  CullRun out;
  if (!compiled.config().culls()) return out;
  const auto tiles = static_cast<std::size_t>(compiled.grid().count());
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(compiled.work(), threads, [&](std::size_t number) {
    cmodel::NullPixels nowhere;
    cmodel::CullLog log;
    cmodel::Model device(compiled.config(), cmodel::StreamScope::Subset, nowhere);
    device.log_culls(&log);
    device.consume(compiled.preamble());
    compiled.emit_tile(
        static_cast<int>(number), [&](std::span<const cmodel::Beat> beats) { device.consume(beats); },
        [&](const cmodel::CullBlock& set) { return device.would_hide(set); });
    device.finish();
    const std::lock_guard lock(mutex);
    out.log.merge(std::move(log));
    out.counts += device.culls();
    out.counters += device.counters();
    if (progress) progress(++done, tiles);
  });
  return out;
}

}  // namespace fastsplat::driver
