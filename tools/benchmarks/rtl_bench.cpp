// SPDX-License-Identifier: Apache-2.0
// The Verilated device of each configuration on a scene's stream: clock cycles per second of the plain simulation (no
// assertions, no checker) and, in the same run, the cost of the checks and the speed-up of the cycle model; of `tiny`
// also what register slices and checkers at the ports cost beside fastsplat_core alone. Takes the best processor time
// of all iterations, so that ratios are meaningful on a shared machine.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "Vfs_bench_core.h"
#include "cmodel/cycles/cycle_model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "scene/scene.hpp"
#include "testbench/check/checked_device.hpp"
#include "testbench/device/rtl_device.hpp"
#include "testbench/device/verilated_device.hpp"
#include "testbench/module/verilated_top.hpp"

namespace fastsplat {
namespace {

double processor_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Two shells with default transfer function and kernel: dense sheets, as sent by a driver.
std::vector<cmodel::Beat> scene_stream(const cmodel::Config& config) {
  scene::SceneDescription description;
  description.volume = "shells:24";
  description.width = description.height = 64;
  const scene::Scene scene = scene::build_scene(description);
  const driver::CompiledFrame compiled(scene, config);
  std::vector<cmodel::Beat> beats;
  compiled.emit([&](std::span<const cmodel::Beat> more) { beats.insert(beats.end(), more.begin(), more.end()); });
  return beats;
}

class Pixels final : public cmodel::PixelSink {
 public:
  void on_tile(cmodel::TilePixels&& tile) override { benchmark::DoNotOptimize(tile.words.data()); }
};

/// fastsplat_core of `tiny` alone.
std::unique_ptr<testbench::RtlDevice> make_core(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                const testbench::RtlOptions& options) {
  auto top = std::make_unique<testbench::VerilatedTop<Vfs_bench_core>>(testbench::simulator_options(options));
  return testbench::make_verilated_device(std::move(top), config, pixels, options);
}

/// Seconds from the first beat to the last pixel.
double run(cmodel::Device& device, std::span<const cmodel::Beat> beats) {
  const double start = processor_seconds();
  device.consume(beats);
  device.finish();
  return processor_seconds() - start;
}

void rtl(benchmark::State& state, const std::string& name) {
  const cmodel::Config config = driver::load_config(name);
  const std::vector<cmodel::Beat> beats = scene_stream(config);
  Pixels pixels;
  double plain = 1e9, asserted = 1e9, checked = 1e9, model = 1e9, core = 1e9, core_asserted = 1e9;
  std::uint64_t cycles = 0;
  for (auto _ : state) {
    testbench::RtlOptions options;
    options.assertions = testbench::Assertions::Off;
    const auto device = testbench::make_rtl_device(config, pixels, options);
    const double seconds = run(*device, beats);
    plain = std::min(plain, seconds);
    cycles = device->cycles();
    state.SetIterationTime(seconds);

    const auto with_assertions = testbench::make_rtl_device(config, pixels);
    asserted = std::min(asserted, run(*with_assertions, beats));

    if (name == "tiny") {
      core = std::min(core, run(*make_core(config, pixels, options), beats));
      core_asserted = std::min(core_asserted, run(*make_core(config, pixels, {}), beats));
    }

    testbench::CheckedDevice scoreboard(config, cmodel::StreamScope::Subset, pixels,
                                        [&](cmodel::PixelSink& tiles, testbench::RawTapSink& taps) {
                                          testbench::RtlOptions with_taps;
                                          with_taps.taps = &taps;
                                          return testbench::make_rtl_device(config, tiles, with_taps);
                                        });
    checked = std::min(checked, run(scoreboard, beats));
    const auto report = scoreboard.report();
    if (report.mismatches != 0 || report.comparisons == 0) {
      state.SkipWithError("the RTL differs from the model");
      break;
    }

    cmodel::CycleModel cycle_model(config, cmodel::StreamScope::Subset);
    model = std::min(model, run(cycle_model, beats));
  }
  const auto count = static_cast<double>(cycles);
  state.counters["cycles/s"] = count / plain;
  state.counters["asserted/plain"] = asserted / plain;
  state.counters["checked/asserted"] = checked / asserted;
  state.counters["checked/plain"] = checked / plain;
  state.counters["plain/cycle_model"] = plain / model;
  if (name != "tiny") return;
  state.counters["plain/core"] = plain / core;
  state.counters["asserted/core_asserted"] = asserted / core_asserted;
}

const bool kRegistered = [] {
  for (const std::string name : {"tiny", "small", "base"})
    benchmark::RegisterBenchmark(("rtl/" + name).c_str(), rtl, name)->UseManualTime()->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace fastsplat
