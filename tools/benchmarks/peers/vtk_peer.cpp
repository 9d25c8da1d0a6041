// SPDX-License-Identifier: Apache-2.0
// Frames of VTK's fixed-point ray caster beside ours, in one process and in random order: CPU time of one thread. First
// compares pictures: post-classified, unshaded ones, which must be alike, and the timed ones.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/splat_store.hpp"
#include "tools/benchmarks/peers/filtered_volume.hpp"
#include "tools/benchmarks/peers/peer_main.hpp"
#include "tools/benchmarks/peers/same_picture.hpp"
#include "tools/benchmarks/peers/vtk_ray_caster.hpp"
#include "tools/benchmarks/scenes.hpp"

namespace fastsplat::bench {
namespace {

constexpr int kSize = 512;
constexpr int kSegmentBits =
    9;  ///< classify.segment_bits of the device that classifies densities, as in docs/against-vtk.md

struct Subject {
  const char* name;
  std::string volume;
};

const scene::Scene& scene(const Subject& subject) { return scene_of(subject.volume, kSize); }

/// Built and drawn once, which makes gradients and tables.
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

/// A single picture, including gradients and tables.
void vtk_first_frame(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) VtkRayCaster(scene(subject)).draw();
}

void golden_frame(benchmark::State& state, const Subject& subject) {
  for (auto _ : state) benchmark::DoNotOptimize(golden_of(scene(subject)).data.data());
}

void device_frame(benchmark::State& state, const Subject& subject, const std::string& config, bool counters) {
  const cmodel::Config device = driver::load_config(config);
  for (auto _ : state)
    benchmark::DoNotOptimize(driver::render(scene(subject), device, {.threads = 1, .counters = counters}).frame);
}

/// A picture after another of the same volume, as in an animation.
void device_later_frame(benchmark::State& state, const Subject& subject, const std::string& config) {
  const cmodel::Config device = driver::load_config(config);
  static std::map<std::string, std::shared_ptr<scene::SplatStore>> stores;
  auto& store = stores[subject.volume];
  scene::Scene later = scene(subject);
  later.store = store ? store : store = std::make_shared<scene::SplatStore>(std::size_t{4} << 30);
  const auto draw = [&] { return driver::render(later, device, {.threads = 1, .counters = false}); };
  draw();
  for (auto _ : state) benchmark::DoNotOptimize(draw().frame);
}

/// A full turn, with one store for our frames.
const std::vector<scene::Scene>& orbit(const Subject& subject) {
  constexpr int kFrames = 36;
  static std::map<std::string, std::vector<scene::Scene>> orbits;
  auto& scenes = orbits[subject.volume];
  if (!scenes.empty()) return scenes;
  const auto store = std::make_shared<scene::SplatStore>(std::size_t{4} << 30);
  for (int frame = 0; frame < kFrames; ++frame) {
    scene::SceneDescription description = description_of(subject.volume, kSize);
    description.camera.azimuth = 360.0 * frame / kFrames;
    scenes.push_back(scene::build_scene(description, scene(subject).volume));
    scenes.back().store = store;
  }
  return scenes;
}

void vtk_orbit(benchmark::State& state, const Subject& subject) {
  VtkRayCaster caster(scene(subject));
  caster.draw();
  for (auto _ : state) {
    for (const scene::Scene& view : orbit(subject)) {
      caster.look(view);
      caster.draw();
    }
  }
}

void device_orbit(benchmark::State& state, const Subject& subject, const std::string& config) {
  const cmodel::Config device = driver::load_config(config);
  const auto& views = orbit(subject);
  benchmark::DoNotOptimize(driver::render(views.front(), device, {.threads = 1, .counters = false}).frame);
  for (auto _ : state) {
    for (const scene::Scene& view : views)
      benchmark::DoNotOptimize(driver::render(view, device, {.threads = 1, .counters = false}).frame);
  }
}

/// Compares two pictures as a line of the results; throws below either minimum.
void alike(benchmark::State& state, const Image& a, const Image& b, double least_psnr, double least_overlap) {
  for (auto _ : state) {
  }
  const double db = psnr(a, b), overlap = silhouette_overlap(a, b);
  state.counters["psnr_db"] = db;
  state.counters["overlap"] = overlap;
  if (!(db >= least_psnr && overlap >= least_overlap))
    throw std::runtime_error("the pictures differ: nothing to compare");
}

/// The scene classified in the given order (Post is VTK's), without shading.
scene::Scene unshaded(const Subject& subject, scene::ClassifyOrder order, double slab_width = 1.0) {
  scene::SceneDescription description = description_of(subject.volume, kSize);
  description.shading = 0;
  description.classify = order;
  description.slab_width = slab_width;
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
  // The timed pictures: each renderer shades in its own way.
  line("/vtk/base", [subject](benchmark::State& state) {
    alike(state, vtk(subject).picture(), device_of(scene(subject), "base"), 15.0, 0.8);
  });
  line("/compact/base", [subject](benchmark::State& state) {
    alike(state, device_of(scene(subject), "compact"), device_of(scene(subject), "base"), 40.0, 0.99);
  });
}

/// Post-classified and unshaded: VTK with a sample every `samples` kernel units on a volume of `points` points per
/// voxel, ours with sheets `sheets` apart. One point per voxel is the volume itself; more are the field that splats
/// reconstruct, interpolated by VTK.
struct PostClassified {
  int points;
  double samples, sheets;
};

const Image& vtk_post(const Subject& subject, int points, double samples) {
  static std::map<std::tuple<std::string, int, double>, Image> pictures;
  const auto [found, fresh] = pictures.try_emplace({subject.name, points, samples});
  if (fresh) {
    const scene::Scene post = unshaded(subject, scene::ClassifyOrder::Post);
    VtkRayCaster caster(post, points == 1 ? *post.volume : filtered(*post.volume, post.kernel, points), samples);
    caster.draw();
    found->second = caster.picture();
  }
  return found->second;
}

/// `who` is golden or a configuration.
const Image& our_post(const Subject& subject, const std::string& who, double sheets) {
  static std::map<std::tuple<std::string, std::string, double>, Image> pictures;
  const auto [found, fresh] = pictures.try_emplace({subject.name, who, sheets});
  if (fresh) {
    const scene::Scene post = unshaded(subject, scene::ClassifyOrder::Post, sheets);
    if (who == "golden") return found->second = golden_of(post);
    cmodel::Config device = driver::load_config(who);
    device.classify_segment_bits = kSegmentBits;
    found->second = driver::to_image(driver::render(post, device, {.threads = 1}).frame);
  }
  return found->second;
}

/// Each of our pictures must be nearer to VTK's of the filtered volume than to that of the volume itself; otherwise
/// they differ by more than the filter.
void post_classified(benchmark::State& state, const Subject& subject, const PostClassified& as) {
  for (auto _ : state) {
  }
  const Image& theirs = vtk_post(subject, as.points, as.samples);
  for (const char* who : {"golden", "base", "fine"}) {
    const Image& ours = our_post(subject, who, as.sheets);
    const double db = psnr(theirs, ours);
    state.counters[who] = db;
    if (as.points > 1 && !(db > psnr(vtk_post(subject, 1, as.samples), ours)))
      throw std::runtime_error("VTK's picture of the filtered volume is not closer to ours than that of the volume");
  }
  state.counters["overlap"] = silhouette_overlap(theirs, our_post(subject, "golden", as.sheets));
  state.counters["points"] = as.points;
  state.counters["samples"] = as.samples;
  state.counters["sheets"] = as.sheets;
}

void register_post_classified(const Subject& subject) {
  int row = 0;
  for (const PostClassified& as : std::initializer_list<PostClassified>{
           {1, 1.0, 1.0}, {1, 0.25, 0.25}, {2, 0.25, 0.25}, {3, 1.0, 1.0}, {3, 0.25, 1.0}, {3, 0.25, 0.25}}) {
    benchmark::RegisterBenchmark((std::string("post/") + subject.name + "/" + std::to_string(++row)).c_str(),
                                 [subject, as](benchmark::State& state) { post_classified(state, subject, as); })
        ->Iterations(1)
        ->Repetitions(1);
  }
}

template <class Draw>
void timed(const std::string& who, const Subject& subject, Draw draw) {
  benchmark::RegisterBenchmark((who + "/" + subject.name).c_str(), draw)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->MeasureProcessCPUTime();
}

/// A turn of the camera in both programs; the pictures' line has the worst frame.
void register_orbit(const Subject& subject) {
  const auto compare = [subject](benchmark::State& state) {
    VtkRayCaster caster(scene(subject));
    double db = 1e9, overlap = 1.0;
    for (const scene::Scene& view : orbit(subject)) {
      caster.look(view);
      caster.draw();
      const Image theirs = caster.picture(), ours = device_of(view, "base");
      db = std::min(db, psnr(theirs, ours));
      overlap = std::min(overlap, silhouette_overlap(theirs, ours));
    }
    for (auto _ : state) {
    }
    state.counters["psnr_db"] = db;
    state.counters["overlap"] = overlap;
    if (!(db >= 15.0 && overlap >= 0.8)) throw std::runtime_error("frames of the orbit differ: nothing to compare");
  };
  benchmark::RegisterBenchmark((std::string("picture/") + subject.name + "/orbit/vtk/base").c_str(), compare)
      ->Iterations(1)
      ->Repetitions(1);
  timed("orbit-vtk", subject, [subject](benchmark::State& state) { vtk_orbit(state, subject); });
  for (const std::string config : {"base", "compact"})
    timed("orbit-" + config, subject,
          [subject, config](benchmark::State& state) { device_orbit(state, subject, config); });
}

void register_frames(const Subject& subject) {
  timed("vtk", subject, [subject](benchmark::State& state) { vtk_frame(state, subject); });
  timed("vtk-first", subject, [subject](benchmark::State& state) { vtk_first_frame(state, subject); });
  timed("golden", subject, [subject](benchmark::State& state) { golden_frame(state, subject); });
  for (const std::string config : {"base", "compact"}) {
    timed(config, subject, [subject, config](benchmark::State& state) { device_frame(state, subject, config, false); });
    timed(config + "-later", subject,
          [subject, config](benchmark::State& state) { device_later_frame(state, subject, config); });
    timed(config + "-counted", subject,
          [subject, config](benchmark::State& state) { device_frame(state, subject, config, true); });
  }
}

}  // namespace
}  // namespace fastsplat::bench

int main(int count, char** arguments) {
  using namespace fastsplat::bench;
  return run_peer(count, arguments, [] {
    if (std::filesystem::exists(kHead)) {
      register_pictures({"head512", kHead});
      register_post_classified({"head512", kHead});
      register_orbit({"head512", kHead});
      register_frames({"head512", kHead});
    }
    register_pictures({"shells256", "shells:256"});
    register_frames({"shells256", "shells:256"});
  });
}
