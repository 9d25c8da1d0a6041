// SPDX-License-Identifier: Apache-2.0
// Whole frames of other shapes than circles in sheets, the fast unit beside the plain one: frame_bench.cpp's head in
// perspective with ellipses, the same with every sample composited, and 3-D Gaussians.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <string>

#include "driver/config/config_file.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "driver/tiles/render.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tools/benchmarks/scenes.hpp"

namespace fastsplat {
namespace {

cmodel::Config sampling() {
  cmodel::Config config = driver::load_config("ellipse");
  config.composite_every_sample = 1;
  return config;
}

void count(benchmark::State& state, const cmodel::Counters& counters, const driver::UnitReport& units) {
  state.counters["splats"] = static_cast<double>(counters.splats);
  state.counters["hidden"] = static_cast<double>(units.hidden_splats);
  state.counters["redone"] = static_cast<double>(units.redone);
}

void head(benchmark::State& state, scene::Method method, driver::Unit unit) {
  scene::SceneDescription description = bench::description_of(bench::kHead, 512);
  description.camera.projection = scene::Projection::Perspective;
  description.footprint.shape = scene::FootprintShape::Ellipse;
  description.method = method;
  const scene::Scene scene = scene::build_scene(description);
  driver::DeviceRender frame;
  for (auto _ : state) frame = driver::render(scene, sampling(), {.threads = 1, .unit = unit});
  count(state, frame.counters, frame.units);
}

/// 100,000 Gaussians at 1920 x 1080, projected beforehand: times the device and its records.
void gaussians(benchmark::State& state, const std::string& cloud, driver::Unit unit, bool counters) {
  scene::GaussianDescription description;
  description.width = 1920, description.height = 1080;
  const auto scene = scene::build_gaussian_scene(
      description, std::make_shared<scene::GaussianCloud>(scene::make_synthetic_gaussians(cloud)));
  cmodel::Config config = sampling();
  config.freeze_below = 7;
  const driver::GaussianFrame frame(scene, scene::project_all(scene), config);
  driver::GaussianRender drawn;
  for (auto _ : state) drawn = driver::render_gaussians(frame, {.threads = 1, .unit = unit, .counters = counters});
  count(state, drawn.counters, drawn.units);
}

/// Runs before main. docs/performance.md finds lines by these names: unit/what/configuration.
const bool kRegistered = [] {
  using driver::Unit;
  const auto line = [](const std::string& name, auto run, auto what) {
    for (const Unit unit : {Unit::Plain, Unit::Fast}) {
      benchmark::RegisterBenchmark(((unit == Unit::Plain ? "plain/" : "fast/") + name).c_str(), run, what, unit)
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1)
          ->MeasureProcessCPUTime();
    }
  };
  if (std::filesystem::exists(bench::kHead)) {
    line("perspective512/ellipse", head, scene::Method::ImageAligned);
    line("samples512/ellipse", head, scene::Method::Westover);
  }
  for (const std::string name : {"shells", "cloud"}) {
    const std::string scene = name + ":100000";
    const auto counting = [](benchmark::State& state, const std::string& cloud, Unit unit) {
      gaussians(state, cloud, unit, true);
    };
    const auto picture = [](benchmark::State& state, const std::string& cloud) {
      gaussians(state, cloud, Unit::Fast, false);
    };
    line(name + "100000/ellipse", counting, scene);
    benchmark::RegisterBenchmark(("picture/" + name + "100000/ellipse").c_str(), picture, scene)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->MeasureProcessCPUTime();
  }
  return true;
}();

}  // namespace
}  // namespace fastsplat
