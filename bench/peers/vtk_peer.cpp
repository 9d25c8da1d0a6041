// Frames of VTK's fixed-point ray caster beside ours, in one process and in random order: CPU time of one thread.
// Before anything is measured, pictures are compared: like with like (post-classified, unshaded), and those that are
// timed.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>

#include "bench/peers/peer_main.hpp"
#include "bench/peers/same_picture.hpp"
#include "bench/peers/vtk_ray_caster.hpp"
#include "bench/scenes.hpp"
#include "driver/config_file.hpp"
#include "driver/render.hpp"
#include "golden/render.hpp"

namespace fastsplat::bench {
namespace {

constexpr int kSize = 512;

struct Subject {
  const char* name;
  std::string volume;
};

const scene::Scene& scene(const Subject& subject) { return scene_of(subject.volume, kSize); }

/// Built once, and drawn once: gradients and tables are made then.
VtkRayCaster& vtk(const Subject& subject) {
  static std::map<std::string, VtkRayCaster> casters;
  const auto [found, fresh] = casters.try_emplace(subject.volume, scene(subject));
  if (fresh) found->second.draw();
  return found->second;
}

Image golden_of(const scene::Scene& scene) {
  return golden::render(scene, {.threads = 1, .progress = {}, .report = nullptr});
}

Image device_of(const scene::Scene& scene, const std::string& config) {
  return driver::to_image(driver::render(scene, driver::load_config(config), {.threads = 1}).frame);
}

void vtk_frame(benchmark::State& state, const Subject& subject) {
  VtkRayCaster& caster = vtk(subject);
  for (auto _ : state) caster.draw();
}

/// A single picture: gradients and tables are part of it.
void vtk_first_frame(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) VtkRayCaster(scene(subject)).draw();
}

void golden_frame(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) benchmark::DoNotOptimize(golden_of(scene(subject)).data.data());
}

void device_frame(benchmark::State& state, const Subject& subject, const std::string& config) {
  const cmodel::Config device = driver::load_config(config);
  for (auto _ : state) benchmark::DoNotOptimize(driver::render(scene(subject), device, {.threads = 1}).frame);
}

/// Two pictures, as a line of the results: a `least` that is not reached fails the run.
void alike(benchmark::State& state, const Image& a, const Image& b, double least_psnr, double least_overlap) {
  for (auto _ : state) {
  }
  const double db = psnr(a, b), overlap = silhouette_overlap(a, b);
  state.counters["psnr_db"] = db;
  state.counters["overlap"] = overlap;
  if (!(db >= least_psnr && overlap >= least_overlap))
    throw std::runtime_error("not the same picture: nothing is to be compared");
}

/// The scene in VTK's order: interpolated, then classified, and neither shades.
scene::Scene unshaded(const Subject& subject, scene::ClassifyOrder order) {
  scene::SceneDescription description = description_of(subject.volume, kSize);
  description.shading = 0;
  description.classify = order;
  return scene::build_scene(description, scene(subject).whole ? scene(subject).whole : scene(subject).volume);
}

void register_pictures(const Subject& subject) {
  const std::string prefix = std::string("picture/") + subject.name;
  const auto line = [&](const std::string& what, auto draw) {
    benchmark::RegisterBenchmark((prefix + what).c_str(), draw)->Iterations(1)->Repetitions(1);
  };
  line("/vtk-unshaded/golden-post", [subject](benchmark::State& state) {
    const scene::Scene post = unshaded(subject, scene::ClassifyOrder::Post);
    VtkRayCaster caster(post);
    caster.draw();
    alike(state, caster.picture(), golden_of(post), 30.0, 0.95);
  });
  line("/golden-pre/golden-post", [subject](benchmark::State& state) {
    alike(state, golden_of(unshaded(subject, scene::ClassifyOrder::Pre)),
          golden_of(unshaded(subject, scene::ClassifyOrder::Post)), 15.0, 0.8);
  });
  // What is timed: shaded by each in its own way.
  line("/vtk/base", [subject](benchmark::State& state) {
    alike(state, vtk(subject).picture(), device_of(scene(subject), "base"), 15.0, 0.8);
  });
  line("/compact/base", [subject](benchmark::State& state) {
    alike(state, device_of(scene(subject), "compact"), device_of(scene(subject), "base"), 40.0, 0.99);
  });
}

void register_frames(const Subject& subject) {
  const auto line = [&](const std::string& who, auto draw) {
    benchmark::RegisterBenchmark((who + "/" + subject.name).c_str(), draw)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->MeasureProcessCPUTime();
  };
  line("vtk", [subject](benchmark::State& state) { vtk_frame(state, subject); });
  line("vtk-first", [subject](benchmark::State& state) { vtk_first_frame(state, subject); });
  line("golden", [subject](benchmark::State& state) { golden_frame(state, subject); });
  for (const char* config : {"base", "compact"})
    line(config, [subject, config](benchmark::State& state) { device_frame(state, subject, config); });
}

}  // namespace
}  // namespace fastsplat::bench

int main(int count, char** arguments) {
  using namespace fastsplat::bench;
  return run_peer(count, arguments, [] {
    if (std::filesystem::exists(kHead)) {
      register_pictures({"head512", kHead});
      register_frames({"head512", kHead});
    }
    register_pictures({"shells256", "shells:256"});
    register_frames({"shells256", "shells:256"});
  });
}
