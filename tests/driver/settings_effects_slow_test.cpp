// SPDX-License-Identifier: Apache-2.0
// Every setting with every method and every engine: accepted settings show in the picture, all others are refused. Each
// is given at its probe value; further settings that it needs are turned on by following the refusals' fixes.
#include <gtest/gtest.h>

#include <set>

#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/scene/follow_fixes_testing.hpp"

namespace fastsplat::driver {
namespace {

using scene::Followed;
using scene::SceneDescription;
using scene::Setting;

/// A picture as displayed, and its cost.
struct Made {
  Image image;
  std::vector<std::uint64_t> work;
};

struct Engine {
  const char* name;
  scene::Offers offers;
  virtual Made make(const scene::Scene& scene) const = 0;
  Engine(const char* called, scene::Offers has) : name(called), offers(has) {}
  virtual ~Engine() = default;
};

class Golden : public Engine {
 public:
  Golden() : Engine("golden", scene::kOffersAll) {}
  Made make(const scene::Scene& scene) const override {
    golden::RenderReport report;
    Made made{
        scene::displayed(golden::render(scene, {.threads = 1, .progress = {}, .report = &report}), scene.description),
        {}};
    if (const auto& culling = report.culling)
      made.work = {culling->splatted, culling->splat_tests, culling->block_tests, culling->blocks};
    return made;
  }
};

class CModel : public Engine {
 public:
  CModel() : Engine("cmodel base", driver::offers(load_config("base"))), config_(load_config("base")) {}
  Made make(const scene::Scene& scene) const override {
    const DeviceRender render = driver::render(scene, config_, {.threads = 1, .progress = {}});
    return {scene::displayed(to_image(render.frame), scene.description),
            {render.report.sheets, render.report.splat_records}};
  }

 private:
  cmodel::Config config_;
};

/// Small, oblique, in front of the eye with any setting, opaque enough to hide something, and with a culling test that
/// shows a difference in such a small picture.
SceneDescription plain_scene(const std::string& method) {
  SceneDescription d;
  d.volume = "shells:10";
  d.width = d.height = 16;
  d.opacity_scale = 4.0;
  d.culling.theta = 0.4;
  apply(scene::setting_of("--method"), method, d);
  return d;
}

/// Counts of the outcomes.
struct Tally {
  int changed = 0, same_by_design = 0, refused = 0, idle = 0;
  std::set<const Setting*> shown;
};

/// A setting refused as without effect would indeed have changed nothing.
void check_idle(const Setting& setting, const SceneDescription& start, const Engine& engine,
                const std::shared_ptr<const volume::Volume>& volume, Tally& tally) {
  SceneDescription alone = start;
  apply(setting, setting.capability.probe, alone);
  if (!scene::refusal(scene::Given{&setting}, alone)) return;
  if (scene::refusal(alone, engine.offers) || scene::refusal(start, engine.offers)) return;
  const Made with = engine.make(build_scene(alone, volume)), without = engine.make(build_scene(start, volume));
  EXPECT_LE(distance(with.image, without.image).largest, 0.001) << "refused, though it has an effect";
  ++tally.idle;
}

void check(const Setting& setting, const std::string& method, const Engine& engine,
           const std::shared_ptr<const volume::Volume>& volume, Tally& tally) {
  SCOPED_TRACE(dotted(setting) + ", " + method + ", " + engine.name);
  const SceneDescription start = plain_scene(method);
  check_idle(setting, start, engine, volume, tally);
  const Followed way = follow_fixes(setting, start, engine.offers, true);
  for (const std::string& said : way.refusals) {
    EXPECT_EQ(said.find('\n'), std::string::npos);
    EXPECT_NE(said.find("; "), std::string::npos) << "no way out: " << said;
  }
  if (!way.accepted) {
    ASSERT_FALSE(way.refusals.empty());
    ++tally.refused;
    return;
  }
  if (value_as_toml(setting, way.with) == value_as_toml(setting, start)) return;  // --method, where it is that method
  const Made with = engine.make(build_scene(way.with, volume));
  if (scene::refusal(way.without, engine.offers)) {  // as texture.where makes a texture possible
    ++tally.changed;
    tally.shown.insert(&setting);
    return;
  }
  const Made without = engine.make(build_scene(way.without, volume));
  if (setting.capability.changes_picture) {
    EXPECT_FALSE(with.image == without.image) << "ignored";
    tally.changed += with.image == without.image ? 0 : 1;
    tally.shown.insert(&setting);
    return;
  }
  EXPECT_LE(distance(with.image, without.image).largest, 3.0);
  ++tally.same_by_design;
  if (with.work != without.work) tally.shown.insert(&setting);
}

TEST(SettingsEffects, each_changes_the_picture_or_is_refused) {
  const auto volume = std::make_shared<const volume::Volume>(volume::load_volume("shells:10"));
  const Golden golden;
  const CModel cmodel;
  int checked = 0;
  Tally all;
  for (const Engine* engine : {static_cast<const Engine*>(&golden), static_cast<const Engine*>(&cmodel)}) {
    Tally tally;
    for (const Setting& setting : scene::settings()) {
      for (const std::string& method : scene::method_names()) {
        check(setting, method, *engine, volume, tally);
        ++checked;
      }
    }
    std::printf(
        "[figure] settings x methods, %s: %d change the picture, %d only the work, %d are refused; "
        "%d idle ones change nothing\n",
        engine->name, tally.changed, tally.same_by_design, tally.refused, tally.idle);
    EXPECT_GT(tally.idle, 30);
    EXPECT_GT(tally.changed, 0);
    EXPECT_GT(tally.refused, 0);
    all.shown.merge(tally.shown);
  }
  for (const Setting& setting : scene::settings())
    EXPECT_TRUE(all.shown.contains(&setting)) << dotted(setting) << " never showed";
  figure("settings_x_methods_x_engines", checked, "combinations, all of them");
  EXPECT_EQ(checked, static_cast<int>(scene::settings().size()) * 5 * 2);
}

}  // namespace
}  // namespace fastsplat::driver
