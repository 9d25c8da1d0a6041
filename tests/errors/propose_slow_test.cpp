// SPDX-License-Identifier: Apache-2.0
// A proposal on a real case: it meets its target, no key of it can be lowered, and its journal replaces simulation.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "analysis/compare.hpp"
#include "analysis/errors/propose.hpp"
#include "analysis/errors/suggestion.hpp"
#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"

namespace fastsplat::analysis {
namespace {

scene::Scene shells(scene::Method method = scene::Method::ImageAligned) {
  scene::SceneDescription description;
  description.volume = "shells:24";
  description.width = description.height = 48;
  description.method = method;
  return scene::build_scene(description);
}

/// By render and compare, independently of the search.
double psnr(const scene::Scene& scene, const cmodel::Config& config) {
  return compare(golden::render(scene), driver::to_image(driver::render(scene, config).frame)).figures.psnr_db;
}

/// The minimum over the scenes, 0 if one cannot be drawn.
double least_psnr(const std::vector<scene::Scene>& scenes, const cmodel::Config& config) {
  double least = std::numeric_limits<double>::infinity();
  for (const scene::Scene& scene : scenes) {
    try {
      least = std::min(least, psnr(scene, config));
    } catch (const UserError&) {
      return 0.0;
    }
  }
  return least;
}

/// Moves that are cheaper than `best`: one key down by one, or one key down by one or two and another up by one. Every
/// one is drawn.
struct Moves {
  int tried = 0, that_do = 0;
};
Moves cheaper_moves(const std::vector<scene::Scene>& scenes, const cmodel::Config& best, double target) {
  Moves moves;
  const double now = cost(best).total();
  const auto attempt = [&](const Steps& steps) {
    const auto config = turned(best, steps);
    if (!config || cost(*config).total() >= now) return;
    ++moves.tried;
    if (least_psnr(scenes, *config) < target) return;
    ++moves.that_do;
    std::printf("%s: cost %.0f for %.0f\n", changes(best, *config).c_str(), cost(*config).total(), now);
  };
  for (std::size_t down = 0; down < freeze_knob(); ++down) {
    Steps steps(knobs().size(), 0);
    steps[down] = -1;
    attempt(steps);
    for (std::size_t up = 0; up < freeze_knob(); ++up) {
      for (const int depth : {1, 2}) {
        if (up == down) continue;
        steps.assign(knobs().size(), 0);
        steps[down] = -depth, steps[up] = 1;
        attempt(steps);
      }
    }
  }
  return moves;
}

class Propose : public ::testing::Test {
 protected:
  ~Propose() override { std::filesystem::remove(path_); }
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("fastsplat_propose_" + std::to_string(::getpid()) + ".jsonl");
  const std::vector<scene::Scene> scenes_{shells()};
  const cmodel::Config base_ = driver::load_config("base");
};

TEST_F(Propose, MeetsTheTargetAndNoMoveMakesItCheaper) {
  Journal journal;
  const Proposal p = propose(scenes_, {"shells"}, base_, parse_targets({"psnr>=50"}), 0.0, journal, 0);
  ASSERT_TRUE(p.search.met);
  const double reached = psnr(scenes_[0], p.search.best);
  EXPECT_GE(reached, 50.0);
  EXPECT_EQ(reached, p.error->psnr_db());
  EXPECT_LT(p.cost.total(), p.cost_from.total());
  int tried = 0;
  double nearest = 0.0;
  for (std::size_t k = 0; k < freeze_knob(); ++k) {
    Steps lower(knobs().size(), 0);
    lower[k] = -1;
    const auto config = turned(p.search.best, lower);
    if (!config || cost(*config).total() > p.cost.total()) continue;
    const double one_less = psnr(scenes_[0], *config);
    EXPECT_LT(one_less, 50.0) << knobs()[k].key << " can be lowered";
    nearest = std::max(nearest, one_less);
    ++tried;
  }
  EXPECT_GE(tried, 7);
  std::printf(
      "[figure] base %.2f dB at cost %.0f -> %.2f dB at cost %.0f; %d keys one lower, nearest %.2f dB; %d frames\n",
      p.error_from->psnr_db(), p.cost_from.total(), reached, p.cost.total(), tried, nearest, p.simulated);
  EXPECT_EQ(p.simulated, p.search.evaluated);
  const Moves moves = cheaper_moves(scenes_, p.search.best, 50.0);
  std::printf("[figure] moves of one key or two that are cheaper = %d, that meet the target = %d\n", moves.tried,
              moves.that_do);
  EXPECT_GT(moves.tried, 100);
  EXPECT_EQ(moves.that_do, 0);
}

TEST_F(Propose, ItsJournalResumesWithoutSimulating) {
  const Targets targets = parse_targets({"rms<=0.5"});
  Proposal first, again, halfway;
  {
    Journal journal(path_);
    first = propose(scenes_, {"shells"}, base_, targets, 0.0, journal, 0);
  }
  {
    Journal journal(path_);
    again = propose(scenes_, {"shells"}, base_, targets, 0.0, journal, 1);
  }
  EXPECT_GT(first.simulated, 0);
  EXPECT_EQ(again.simulated, 0);
  EXPECT_EQ(driver::to_toml(again.search.best), driver::to_toml(first.search.best));
  // Interrupted halfway: only the missing frames are simulated.
  std::ostringstream all;
  all << std::ifstream(path_, std::ios::binary).rdbuf();
  std::filesystem::resize_file(path_, all.str().size() / 2);
  {
    Journal journal(path_);
    halfway = propose(scenes_, {"shells"}, base_, targets, 0.0, journal, 2);
  }
  EXPECT_GT(halfway.simulated, 0);
  EXPECT_LT(halfway.simulated, first.simulated);
  EXPECT_EQ(driver::to_toml(halfway.search.best), driver::to_toml(first.search.best));
  std::ostringstream whole;
  whole << std::ifstream(path_, std::ios::binary).rdbuf();
  EXPECT_EQ(whole.str(), all.str()) << "the journal of an interrupted search is that of one that was not";
  std::printf("[figure] frames: %d at first, %d resumed, %d from half a journal\n", first.simulated, again.simulated,
              halfway.simulated);
}

TEST_F(Propose, HoldsOnEveryScene) {
  const std::vector<scene::Scene> both{shells(), shells(scene::Method::XRay)};
  Journal journal;
  const Proposal p = propose(both, {"slabs", "x-ray"}, base_, parse_targets({"psnr>=45"}), 0.0, journal, 0);
  ASSERT_TRUE(p.search.met);
  for (const scene::Scene& scene : both) EXPECT_GE(psnr(scene, p.search.best), 45.0);
  std::printf("[figure] two scenes: %.2f and %.2f dB at cost %.0f, %d frames\n", psnr(both[0], p.search.best),
              psnr(both[1], p.search.best), p.cost.total(), p.simulated);
  // Each figure is the worst of the scenes.
  Fidelity worst_of;
  for (const scene::Scene& scene : both) {
    const auto one = compare(golden::render(scene), driver::to_image(driver::render(scene, base_).frame)).figures;
    std::printf("[figure] base: RMS %.5f, max %.4f LSB8\n", one.rmse_lsb, one.max_abs_lsb);
    worst_of = {std::max(worst_of.rms_lsb, one.rmse_lsb), std::max(worst_of.max_lsb, one.max_abs_lsb)};
  }
  EXPECT_EQ(p.error_from->rms_lsb, worst_of.rms_lsb);
  EXPECT_EQ(p.error_from->max_lsb, worst_of.max_lsb);
  // "One less gives" is the worst of the scenes.
  int figures = 0;
  for (std::size_t k = 0; k < freeze_knob(); ++k) {
    const KeyOutcome& key = p.search.keys[k];
    if (key.lower.empty() || key.dearer) continue;
    Steps lower(knobs().size(), 0);
    lower[k] = -1;
    const double worst = least_psnr(both, *turned(p.search.best, lower));
    if (!std::isfinite(key.lowered.excess)) {
      EXPECT_EQ(worst, 0.0) << key.key;
    } else {
      EXPECT_NEAR(key.lowered.excess, std::pow(10.0, (45.0 - worst) / 20.0), 1e-9 * key.lowered.excess) << key.key;
    }
    ++figures;
  }
  const Moves moves = cheaper_moves(both, p.search.best, 45.0);
  std::printf("[figure] figures of one less compared = %d; cheaper moves = %d, that meet the target = %d\n", figures,
              moves.tried, moves.that_do);
  EXPECT_GT(figures, 7);
  EXPECT_GT(moves.tried, 100);
  EXPECT_EQ(moves.that_do, 0);
}

TEST_F(Propose, ScenesThatDifferAreNotTheSameInAJournal) {
  auto other = scenes_[0].description;
  other.camera.azimuth += 1.0;
  EXPECT_NE(scene_hash(scenes_[0]), scene_hash(scene::build_scene(other)));
  EXPECT_EQ(scene_hash(scenes_[0]), scene_hash(shells()));
}

}  // namespace
}  // namespace fastsplat::analysis
