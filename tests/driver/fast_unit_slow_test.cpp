// The fast unit draws what the plain unit draws: words, counters and report of whole frames, over configurations,
// methods, views, threads, heights of bands and every kind of vector instruction this processor has.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdio>
#include <map>

#include "cmodel/fast/row_kernel.hpp"
#include "driver/config_file.hpp"
#include "driver/render.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {
namespace {

struct Setting {
  const char* name;
  void (*apply)(scene::SceneDescription&);
};
const Setting kMethods[] = {
    {"image", [](scene::SceneDescription&) {}},
    {"image_opaque", [](scene::SceneDescription& d) { d.opacity_scale = 12; }},
    {"image_additive", [](scene::SceneDescription& d) { d.slab_opacity = scene::SlabOpacity::Additive; }},
    {"image_wide_slab", [](scene::SceneDescription& d) { d.slab_width = 3.7; }},
    {"axis", [](scene::SceneDescription& d) { d.method = scene::Method::AxisAligned; }},
    {"xray", [](scene::SceneDescription& d) { d.method = scene::Method::XRay; }},
    {"xray_bright", [](scene::SceneDescription& d) { d.method = scene::Method::XRay, d.xray_exposure = 3.0; }},
};
const Setting kViews[] = {
    {"turned", [](scene::SceneDescription& d) { d.camera.azimuth = 33, d.camera.elevation = 21, d.camera.roll = 5; }},
    {"near", [](scene::SceneDescription& d) { d.camera.azimuth = -50, d.camera.zoom = 2.3; }},
    {"far", [](scene::SceneDescription& d) { d.camera.zoom = 0.4; }},
    {"perspective",
     [](scene::SceneDescription& d) {
       d.camera.projection = scene::Projection::Perspective, d.camera.azimuth = 20, d.camera.fov = 45;
     }},
};

/// The vector targets one by one, and the processor's own choice at the end.
class Targets {
 public:
  Targets() {
    std::uint64_t left = static_cast<std::uint64_t>(hwy::SupportedTargets());
    for (; left != 0; left &= left - 1) {
      choose(left & (~left + 1));
      if (cmodel::fast::has_vectors()) all_.push_back(left & (~left + 1));
    }
    choose(0);
  }
  ~Targets() { choose(0); }
  void choose(std::uint64_t target) {
    hwy::SetSupportedTargetsForTest(static_cast<std::int64_t>(target));
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  const std::vector<std::uint64_t>& all() const { return all_; }

 private:
  std::vector<std::uint64_t> all_;
};

bool same_report(const DriverReport& a, const DriverReport& b) {
  return a.splat_records == b.splat_records && a.saturated_records == b.saturated_records && a.sheets == b.sheets &&
         a.tiles == b.tiles;
}

TEST(FastUnit, DrawsThePlainUnitsWordsAndCounters) {
  Targets targets;
  ASSERT_FALSE(targets.all().empty()) << "no vector instructions here: nothing could be compared";
  std::size_t combinations = 0, frames = 0, different = 0, words = 0;
  std::map<std::string, UnitReport> units;
  std::map<std::string, int> drawn_with;
  const int threads[] = {1, 2, 3, 8};
  const int band_rows[] = {0, 1, 1000, 2, 64, 7, 12};  // rounded up to blocks of 2 to 16 pixels; tiles of 32 to 128
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    for (const Setting& method : kMethods) {
      for (const Setting& view : kViews) {
        for (const char* volume : {"shells:16", "marschner-lobb:18"}) {
          scene::SceneDescription description;
          description.volume = volume;
          description.transfer_function = std::string(volume).starts_with("shells") ? "ct-head" : "default";
          description.width = 75, description.height = 50;
          method.apply(description);
          view.apply(description);
          const std::string what = name + " " + method.name + " " + view.name + " " + volume;
          DeviceRender plain;
          scene::Scene scene = scene::build_scene(description);
          try {
            plain = render(scene, config, {.threads = 1, .unit = Unit::Plain});
          } catch (const UserError&) {
            continue;  // a footprint wider than the RLUT
          }
          EXPECT_EQ(plain.units.fast, 0u) << what;
          for (const std::uint64_t target : targets.all()) {
            targets.choose(target);
            // Every target and configuration meets every number of threads and every height.
            const int some = threads[(frames + combinations) % 4], rows = band_rows[frames % 7];
            const DeviceRender fast = render(scene, config, {.threads = some, .unit = Unit::Fast, .band_rows = rows});
            ++frames;
            ++drawn_with[cmodel::fast::vector_target()];
            words += fast.frame.words.size();
            UnitReport& sum = units[name];
            sum.fast += fast.units.fast, sum.plain += fast.units.plain, sum.redone += fast.units.redone;
            sum.hidden_splats += fast.units.hidden_splats;
            EXPECT_EQ(fast.units.plain, fast.units.redone) << what << ": the fast unit was not chosen";
            const char* difference = fast.frame.words != plain.frame.words     ? "words"
                                     : !(fast.counters == plain.counters)      ? "counters"
                                     : !same_report(fast.report, plain.report) ? "reports"
                                                                               : nullptr;
            if (difference != nullptr && ++different <= 5) {
              ADD_FAILURE() << what << " on " << cmodel::fast::vector_target() << ", " << some << " threads, bands of "
                            << rows << " rows: " << difference << " differ";
            }
          }
          ++combinations;
        }
      }
    }
  }
  std::printf(
      "[figure] combinations of configuration, method, view and volume = %zu, frames %zu, words %zu, "
      "different %zu (limit 0)\n",
      combinations, frames, words, different);
  for (const auto& [name, unit] : units) {
    std::printf("[figure] %s: tiles drawn fast %llu, redone by the plain unit %llu, splats hidden %llu\n", name.c_str(),
                static_cast<unsigned long long>(unit.fast), static_cast<unsigned long long>(unit.redone),
                static_cast<unsigned long long>(unit.hidden_splats));
    EXPECT_GT(unit.fast, 0u) << name;
  }
  for (const auto& [name, count] : drawn_with) std::printf("[figure] frames drawn with %s = %d\n", name.c_str(), count);
  EXPECT_EQ(different, 0u);
  EXPECT_GT(combinations, 300u);
}

}  // namespace
}  // namespace fastsplat::driver
