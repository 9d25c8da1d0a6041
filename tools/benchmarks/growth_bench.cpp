// SPDX-License-Identifier: Apache-2.0
// Growth of frame time with splats, and savings by early termination on opaque volumes: fast unit, one thread.
#include <benchmark/benchmark.h>

#include <map>
#include <stdexcept>
#include <string>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "tools/benchmarks/scenes.hpp"

namespace fastsplat {
namespace {

cmodel::Config never_frozen() {
  cmodel::Config config = driver::load_config("base");
  if (set(config, "composite.freeze_below", "0")) throw std::logic_error("0 freezes nothing");
  return config;
}

void frame(benchmark::State& state, const scene::Scene& scene, const cmodel::Config& config) {
  driver::DeviceRender out;
  for (auto _ : state) out = driver::render(scene, config, {.threads = 1});
  state.counters["voxels"] = static_cast<double>(out.report.voxels - out.report.vanished_voxels);
  state.counters["splats"] = static_cast<double>(out.counters.splats);
  state.counters["hidden"] = static_cast<double>(out.units.hidden_splats);
  state.counters["redone"] = static_cast<double>(out.units.redone);
}

void growth(benchmark::State& state, int side) {
  frame(state, bench::scene_of("shells:" + std::to_string(side), 512), driver::load_config("base"));
}

/// The fast unit has no switch for this; a device without early termination hides no splat. Its picture differs in its
/// last words, by what lies behind a transmittance of 2^-10; it is equal if nothing is hidden.
void freezing(benchmark::State& state, const std::string& volume, const std::string& transfer_function,
              double opacity_scale, bool on) {
  static std::map<std::string, scene::Scene> scenes;
  auto found = scenes.find(volume + transfer_function);
  if (found == scenes.end()) {
    auto description = bench::description_of(volume, 512);
    description.transfer_function = transfer_function;
    description.opacity_scale = opacity_scale;
    found = scenes.emplace(volume + transfer_function, scene::build_scene(description)).first;
  }
  frame(state, found->second, on ? driver::load_config("base") : never_frozen());
}

/// Runs before main. docs/performance.md finds lines by these names: what/which/configuration.
const bool kRegistered = [] {
  const auto line = [](const std::string& name, auto run, auto... with) {
    benchmark::RegisterBenchmark(name.c_str(), run, with...)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->MeasureProcessCPUTime();
  };
  for (const int side : {32, 48, 64, 96, 128, 192})
    line("growth/shells" + std::to_string(side) + "/base", growth, side);
  for (const bool on : {true, false}) {
    const std::string which = on ? "freezing" : "never-frozen";
    line("opaque-cube256/" + which, freezing, "binary-cube:256", "binary", 1.0, on);
    line("opaque-shells256/" + which, freezing, "shells:256", "binary", 1.0, on);
    line("clear-shells256/" + which, freezing, "shells:256", "default", 0.2, on);
  }
  return true;
}();

}  // namespace
}  // namespace fastsplat
