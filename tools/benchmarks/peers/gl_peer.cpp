// SPDX-License-Identifier: Apache-2.0
// X-rays by textured quads in software OpenGL beside ours, in one process: CPU time of all its threads. GL's frame is
// drawing alone; ours is timed both as a whole and from the compiled frame on, which is what GL does.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tools/benchmarks/peers/gl_splatter.hpp"
#include "tools/benchmarks/peers/peer_main.hpp"
#include "tools/benchmarks/peers/same_picture.hpp"
#include "tools/benchmarks/scenes.hpp"

namespace fastsplat::bench {
namespace {

const scene::Scene& xray() {
  static const scene::Scene scene = [] {
    scene::SceneDescription description = description_of(kHead, 512);
    description.method = scene::Method::XRay;
    return scene::build_scene(description);
  }();
  return scene;
}

GlSplatter& gl(Sums sums) {
  static GlSplatter half(xray(), Sums::Half), whole(xray(), Sums::Float);
  return sums == Sums::Half ? half : whole;
}

Image device_picture(const std::string& config) {
  return driver::to_image(driver::render(xray(), driver::load_config(config), {.threads = 1}).frame);
}

/// 16-bit float sums are truncated, not rounded, with every quad: that picture is the worst here.
void pictures(benchmark::State& state, Sums sums, const std::string& what) {
  gl(sums).draw();
  const Image ours = what == "golden" ? golden::render(xray(), {.threads = 1, .progress = {}, .report = nullptr})
                                      : device_picture(what);
  for (auto _ : state) {
  }
  const double db = psnr(gl(sums).picture(), ours);
  state.counters["psnr_db"] = db;
  state.counters["quads"] = static_cast<double>(gl(sums).quads());
  state.SetLabel(gl(sums).renderer());
  if (!(db >= (sums == Sums::Half ? 30.0 : 60.0))) throw std::runtime_error("the pictures differ: nothing to compare");
}

void gl_draw(benchmark::State& state, Sums sums) {
  gl(sums).draw();
  for (auto _ : state) gl(sums).draw();
}

void device_frame(benchmark::State& state, const std::string& config, driver::Unit unit) {
  const cmodel::Config device = driver::load_config(config);
  for (auto _ : state)
    benchmark::DoNotOptimize(driver::render(xray(), device, {.threads = 1, .unit = unit}).frame.words.data());
}

template <class Word>
void draw_tiles(benchmark::State& state, const driver::CompiledFrame& frame, const cmodel::fast::FrameTables& tables) {
  cmodel::NullPixels pixels;
  cmodel::fast::TileUnit<Word> unit(tables, pixels);
  for (auto _ : state) {
    for (int tile = 0; tile < frame.grid().count(); ++tile) {
      frame.draw_band(tile, 0, unit);
      if (!unit.sound()) throw std::runtime_error("a sum saturated: the measurement would be invalid");
    }
  }
}

void device_draw(benchmark::State& state, const std::string& config) {
  const cmodel::Config device = driver::load_config(config);
  const driver::CompiledFrame frame(xray(), device);
  const auto tables = cmodel::fast::frame_tables(device, frame.preamble());
  if (!tables) throw std::runtime_error("the fast unit is not available");
  if (tables->plan.narrow)
    draw_tiles<std::uint16_t>(state, frame, *tables);
  else
    draw_tiles<std::uint32_t>(state, frame, *tables);
}

void register_all() {
  using driver::Unit;
  const auto line = [](const std::string& name, auto run, auto... with) {
    return benchmark::RegisterBenchmark(name.c_str(), run, with...)->Iterations(1)->Unit(benchmark::kMillisecond);
  };
  for (const auto& [name, sums] : {std::pair{"gl16", Sums::Half}, {"gl32", Sums::Float}}) {
    for (const char* config : {"golden", "base", "compact"})
      line(std::string("picture/") + name + "/" + config, pictures, sums, std::string(config))->Repetitions(1);
    line(std::string(name) + "/draw", gl_draw, sums)->MeasureProcessCPUTime();
  }
  for (const char* config : {"base", "compact"}) {
    line(std::string("plain/frame/") + config, device_frame, std::string(config), Unit::Plain)->MeasureProcessCPUTime();
    line(std::string("fast/frame/") + config, device_frame, std::string(config), Unit::Fast)->MeasureProcessCPUTime();
    line(std::string("fast/draw/") + config, device_draw, std::string(config))->MeasureProcessCPUTime();
  }
}

}  // namespace
}  // namespace fastsplat::bench

int main(int count, char** arguments) {
  // Software rendering in this thread only; CPU time counts all threads.
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 1);
  return fastsplat::bench::run_peer(count, arguments, [] {
    if (!std::filesystem::exists(fastsplat::bench::kHead)) throw std::runtime_error("mricron-data is not installed");
    fastsplat::bench::register_all();
  });
}
