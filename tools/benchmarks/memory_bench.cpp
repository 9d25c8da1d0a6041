// SPDX-License-Identifier: Apache-2.0
// Peak memory of a frame: that of this process, which renders nothing else.
#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "tools/benchmarks/scenes.hpp"

namespace fastsplat {
namespace {

/// VmHWM, in millions of bytes.
double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return 1.024e-3 * std::stod(line.substr(6));
  }
  return 0.0;
}

void memory(benchmark::State& state) {
  const cmodel::Config device = driver::load_config("base");
  for (auto _ : state) {
    const scene::Scene scene = scene::build_scene(bench::description_of("shells:320", 1024));
    benchmark::DoNotOptimize(driver::render(scene, device, {.threads = 1}).frame.words.data());
  }
  state.counters["peak_mb"] = peak_megabytes();
}

BENCHMARK(memory)->Name("memory/shells320/base")->Iterations(1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace fastsplat
