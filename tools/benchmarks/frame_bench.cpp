// SPDX-License-Identifier: Apache-2.0
// Whole frames, and rows of footprints: the fast unit beside the plain one, in one run. The head is from Debian
// (mricron-data); without it those lines are missing. Only ratios within one run are meaningful. tools/performance
// makes docs/performance.md from them.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/scene.hpp"
#include "tools/benchmarks/row_units.hpp"
#include "tools/benchmarks/scenes.hpp"

namespace fastsplat {
namespace {

using bench::fast_rows;
using bench::kHead;
using bench::plain_rows;
using bench::scene_of;

void device_frame(benchmark::State& state, const std::string& volume, int size, const std::string& config,
                  driver::Unit unit, int threads, bool counters) {
  const scene::Scene& scene = scene_of(volume, size);
  const cmodel::Config device = driver::load_config(config);
  driver::DeviceRender frame;
  for (auto _ : state) frame = driver::render(scene, device, {.threads = threads, .unit = unit, .counters = counters});
  state.counters["splats"] = static_cast<double>(frame.counters.splats);
  state.counters["hidden"] = static_cast<double>(frame.units.hidden_splats);
  state.counters["redone"] = static_cast<double>(frame.units.redone);
}

void golden_frame(benchmark::State& state, int size, scene::Method method, bool plain, int threads) {
  scene::Scene scene = scene_of(kHead, size);
  scene.description.method = method;
  golden::RenderReport report;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        golden::render(scene, {.threads = threads, .progress = {}, .report = &report, .plain = plain}).data.data());
  }
  state.counters["splats"] = static_cast<double>(report.footprints);
  state.counters["hidden"] = static_cast<double>(report.hidden_footprints);
}

/// Runs before main. docs/performance.md finds lines by these names: unit/what/configuration.
const bool kRegistered = [] {
  using driver::Unit;
  const auto frame = [](const std::string& name, const std::string& volume, int size, const std::string& config,
                        Unit unit, int threads = 1, bool counters = true) {
    auto* line = benchmark::RegisterBenchmark(name.c_str(), device_frame, volume, size, config, unit, threads, counters);
    line->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime();
    if (threads > 1) line->UseRealTime();
  };
  if (std::filesystem::exists(kHead)) {
    for (const char* config : {"base", "compact", "tiny"}) {
      frame(std::string("plain/head512/") + config, kHead, 512, config, Unit::Plain);
      frame(std::string("fast/head512/") + config, kHead, 512, config, Unit::Fast);
      frame(std::string("picture/head512/") + config, kHead, 512, config, Unit::Fast, 1, false);
    }
    for (const int size : {128, 1024})
      frame("picture/head" + std::to_string(size) + "/base", kHead, size, "base", Unit::Fast, 1, false);
    for (const int size : {128, 256, 1024, 2048})
      frame("fast/head" + std::to_string(size) + "/base", kHead, size, "base", Unit::Fast);
    frame("wall1/head512/base", kHead, 512, "base", Unit::Fast);
    frame("wall2/head512/base", kHead, 512, "base", Unit::Fast, 2);
    frame("wall1/picture512/base", kHead, 512, "base", Unit::Fast, 1, false);
    frame("wall2/picture512/base", kHead, 512, "base", Unit::Fast, 2, false);
    const auto golden = [](const char* name, int size, scene::Method method, bool plain, int threads = 1) {
      auto* line = benchmark::RegisterBenchmark(name, golden_frame, size, method, plain, threads);
      line->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime();
      if (threads > 1) line->UseRealTime();
    };
    using scene::Method;
    golden("plain/head512/golden", 512, Method::ImageAligned, true);
    golden("fast/head512/golden", 512, Method::ImageAligned, false);
    golden("plain/rays128/golden", 128, Method::RayCast, true);
    golden("fast/rays128/golden", 128, Method::RayCast, false);
    golden("wall1/head512/golden", 512, Method::ImageAligned, false);
    golden("wall2/head512/golden", 512, Method::ImageAligned, false, 2);
  }
  for (const char* config : {"base", "compact"}) {
    frame(std::string("fast/shells256/") + config, "shells:256", 512, config, Unit::Fast);
    frame(std::string("picture/shells256/") + config, "shells:256", 512, config, Unit::Fast, 1, false);
  }
  for (const char* config : {"compact", "base"}) {
    for (const int extent : {5, 7, 9, 16}) {
      const std::string what = "/rows" + std::to_string(extent) + "/" + config;
      benchmark::RegisterBenchmark(("plain" + what).c_str(), plain_rows, config, extent)->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(("fast" + what).c_str(), fast_rows, config, extent)->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace fastsplat
