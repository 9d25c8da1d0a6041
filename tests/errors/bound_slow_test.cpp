// SPDX-License-Identifier: Apache-2.0
// The proved worst case: no pixel of any picture has a larger error, and no single step does.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/errors/bound.hpp"
#include "base/error.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/errors/bound_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Chain, stages::Mixture, stages::Step, test::BoundTotals, test::hold;

TEST(Bound, HoldsOnEveryPixelOfNamedConfigurations) {
  BoundTotals totals;
  for (const std::string& name : test::config_names()) {
    for (const auto& description : stages::test::small_scenes()) {
      const scene::Scene scene = scene::build_scene(description);
      const cmodel::Config config = test::named_config(name);
      hold(Chain(scene, config), totals);
    }
  }
  totals.print("named configurations");
  EXPECT_GT(totals.worst, 0.5);  // a worst case that is not far above
}

TEST(Bound, HoldsOnEveryPixelAtRandom) {
  test::Random random(test::seed_or(3100));
  BoundTotals totals;
  while (totals.frames < 300) {
    const cmodel::Config config = test::random_config(random);
    const scene::Scene scene = scene::build_scene(stages::test::random_scene(random));
    try {
      hold(Chain(scene, config), totals);
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
  totals.print("at random");
}

/// Opacities at which exp(-tau) is 0 in doubles and exp(tau) is infinite, and words saturate.
TEST(Bound, HoldsWhereNothingIsSeenBehindASheet) {
  test::Random random(test::seed_or(3102));
  BoundTotals totals;
  while (totals.frames < 300) {
    const cmodel::Config config = test::random_config(random);
    scene::SceneDescription description = stages::test::random_scene(random);
    description.opacity_scale = std::exp2(static_cast<double>(random.between(8, 16)));
    try {
      const scene::Scene scene = scene::build_scene(description);
      hold(Chain(scene, config), totals);
    } catch (const UserError&) {
      continue;  // the configuration cannot hold the scene
    }
  }
  totals.print("opaque");
}

TEST(Bound, HoldsForEveryKindOfIndexWhereItsGeometryIsKnown) {
  BoundTotals totals;
  for (const int kind : {0, 1, 2, 3, 5}) {
    for (const char* name : {"base", "compact", "tiny"}) {
      cmodel::Config config = test::named_config(name);
      config.index_kind = kind;
      for (const auto& description : stages::test::small_scenes()) {
        const scene::Scene scene = scene::build_scene(description);
        hold(Chain(scene, config), totals, Known::Geometry);
      }
    }
  }
  totals.print("other kinds of index");
}

/// The page's bound of each step, if it can stand alone: this step (or two that go together) on the device, all others
/// real.
TEST(Bound, HoldsForEachStepAlone) {
  const std::vector<std::vector<Step>> alone{{Step::Position, Step::Snap},
                                             {Step::Radius},
                                             {Step::Distance},
                                             {Step::Index},
                                             {Step::Weight},
                                             {Step::Emission},
                                             {Step::Depth},
                                             {Step::Phi},
                                             {Step::Share},
                                             {Step::Product},
                                             {Step::Factor},
                                             {Step::Slab},
                                             {Step::Composite},
                                             {Step::Freeze}};
  test::Random random(test::seed_or(3101));
  std::vector<scene::SceneDescription> scenes = stages::test::small_scenes();
  while (scenes.size() < 12) scenes.push_back(stages::test::random_scene(random));
  for (const auto& steps : alone) {
    BoundTotals totals;
    std::vector<cmodel::Config> configs;
    for (const char* name : {"base", "compact", "tiny", "year2000"}) configs.push_back(test::named_config(name));
    for (const auto snap : {cmodel::Rounding::RND, cmodel::Rounding::TRN, cmodel::Rounding::RND_CONV}) {
      configs.push_back(test::named_config("base"));  // positions finer than what they are snapped to
      configs.back().phases = 8;
      configs.back().rounding_snap = static_cast<int>(snap);
    }
    for (cmodel::Config& config : configs) {
      config.rounding_carry = static_cast<int>(cmodel::Carry::Off);
      for (const auto& description : scenes) {
        // Added sums need no rounding to become opacities if they have few enough bits: alone they are not words.
        if (steps.front() == Step::Slab && description.slab_opacity == scene::SlabOpacity::Additive) continue;
        try {
          const scene::Scene scene = scene::build_scene(description);
          const Chain chain(scene, config);
          hold(chain, Mixture{}.with(steps), totals);
        } catch (const UserError&) {
          continue;
        }
      }
    }
    totals.print(stages::facts(steps.front()).name);
  }
}

}  // namespace
}  // namespace fastsplat::analysis
