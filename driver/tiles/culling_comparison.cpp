// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/culling_comparison.hpp"

#include "cmodel/cycles/cycle_model.hpp"
#include "driver/tiles/cull_log.hpp"

namespace fastsplat::driver {

std::vector<CullRow> compare_culling(const scene::Scene& scene, const cmodel::Config& config, std::uint64_t latency,
                                     int threads, const Progress& progress) {
  std::vector<CullRow> rows;
  const cmodel::Terminations known = terminations(scene, config, threads);
  for (const auto map : {cmodel::CullMap::Off, cmodel::CullMap::Block, cmodel::CullMap::Pixel}) {
    cmodel::Config device = config;
    device.cull_map = static_cast<int>(map);
    const CompiledFrame compiled(scene, device, threads);
    const CullRun run = run_culls(compiled, known, threads, progress);
    cmodel::CycleOptions options;
    if (device.culls()) options.culls = &run.log;
    cmodel::CycleModel sent(device, cmodel::StreamScope::Subset, options);
    options.fetch = cmodel::Fetch{latency};
    cmodel::CycleModel fetched(device, cmodel::StreamScope::Subset, options);
    compiled.emit([&](std::span<const cmodel::Beat> beats) {
      sent.consume(beats);
      if (device.culls()) fetched.consume(beats);
    });
    const auto add = [&](cmodel::CycleModel& model, std::optional<std::uint64_t> fetch) {
      model.finish();
      rows.push_back({.map = cmodel::text_of(device, *cmodel::find_key("cull.map")),
                      .fetch = fetch,
                      .cycles = model.stalls().busy,
                      .beats = model.sent().total(),
                      .account = model.account(),
                      .counters = model.counters(),
                      .culls = run.counts});
    };
    add(sent, {});
    if (device.culls()) add(fetched, latency);
  }
  return rows;
}

double share_drawn(const CullRow& row, const CullRow& off) {
  if (off.counters.splats == 0) return 0.0;
  return static_cast<double>(row.counters.splats - row.culls.hidden_splats) / static_cast<double>(off.counters.splats);
}

}  // namespace fastsplat::driver
