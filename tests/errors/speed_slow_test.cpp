// SPDX-License-Identifier: Apache-2.0
// A proposal for frames a second: met when counted independently, and no neighbour has less area. Neighbours are all
// other arrangements, numbers of devices, and moves of one or two widths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "analysis/errors/propose.hpp"
#include "analysis/errors/suggestion.hpp"
#include "base/error.hpp"
#include "cmodel/cycles/cycle_cluster.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/cull_log.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;

constexpr double kClock = 100.0;

std::vector<scene::Scene> scenes() {
  scene::SceneDescription description;
  description.volume = "shells:32";
  description.width = description.height = 96;
  description.opacity_scale = 2.0;  // hides some
  std::vector<scene::Scene> out{scene::build_scene(description)};
  description.volume = "fire:24";
  description.transfer_function = "fire";
  description.opacity_scale = 1.0;
  out.push_back(scene::build_scene(description));
  return out;
}

/// By render and compare, independently of the search.
bool near_enough(const std::vector<scene::Scene>& scenes, const Config& config, const Targets& targets) {
  static std::vector<Image> golden;
  if (golden.empty()) {
    for (const scene::Scene& scene : scenes) golden.push_back(golden::render(scene));
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Image image = driver::to_image(driver::render(scenes[i], config).frame);
    if (!targets.met(fidelity(golden[i], image, 1))) return false;
  }
  return true;
}

/// The scenes' streams for one device, fetched if it culls.
class Counted {
 public:
  Counted(const std::vector<scene::Scene>& scenes, const Config& config) : config_(config) {
    for (const scene::Scene& scene : scenes) {
      frames_.push_back(std::make_unique<driver::CompiledFrame>(scene, config));
      culls_.push_back(driver::run_culls(*frames_.back(), driver::terminations(scene, config)));
    }
  }
  /// Of the slowest scene.
  double fps(int devices) const {
    std::uint64_t slowest = 0;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      cmodel::ClusterOptions options{.devices = devices};
      if (config_.culls()) options.device.culls = &culls_[i].log, options.device.fetch = cmodel::Fetch{40};
      cmodel::CycleCluster cluster(config_, cmodel::StreamScope::Subset, options);
      frames_[i]->emit([&](std::span<const cmodel::Beat> beats) { cluster.consume(beats); });
      cluster.finish();
      slowest = std::max(slowest, cluster.frame_cycles());
    }
    return 1e6 * kClock / static_cast<double>(slowest);
  }

 private:
  Config config_;
  std::vector<std::unique_ptr<driver::CompiledFrame>> frames_;
  std::vector<driver::CullRun> culls_;
};

struct Neighbours {
  int tried = 0, that_do = 0;
};

/// Every arrangement with every number of devices that has less area.
Neighbours arrangements(const std::vector<scene::Scene>& scenes, const Proposal& p) {
  Neighbours out;
  const double now = p.speed->proposed->equivalent_luts();
  for (const SpeedKeys& keys : speed_choices(p.search.best)) {
    const Config config = *arranged(p.search.best, keys);
    const double each = area(config).equivalent_luts();
    if (each >= now) continue;
    try {
      const Counted counted(scenes, config);
      for (int devices = 1; devices * each < now && devices <= kMostDevices; ++devices) {
        ++out.tried;
        if (counted.fps(devices) < *p.targets.fps) continue;
        ++out.that_do;
        std::printf("%d devices of %s: area %.0f for %.0f\n", devices, keys.text().c_str(), devices * each, now);
      }
    } catch (const UserError&) {
      continue;  // the scene does not fit
    }
  }
  return out;
}

/// Whether the step down could do with finer words of all others: else it is not paired (docs/errors.md, section 6).
bool could_do(const std::vector<scene::Scene>& scenes, const Proposal& p, Steps steps, std::size_t down) {
  for (std::size_t k = 0; k < freeze_knob(); ++k) {
    if (k == down) continue;
    ++steps[k];
    if (!turned(p.config, steps)) --steps[k];
  }
  const auto config = turned(p.config, steps);
  return config && near_enough(scenes, *config, p.targets);
}

/// One width down by one, or one down by one or two and another up by one, with less area.
Neighbours widths(const std::vector<scene::Scene>& scenes, const Proposal& p) {
  Neighbours out;
  const double now = area(p.config).equivalent_luts();
  const auto attempt = [&](const Steps& steps) {
    const auto config = turned(p.config, steps);
    if (!config || area(*config).equivalent_luts() >= now) return;
    ++out.tried;
    try {
      if (!near_enough(scenes, *config, p.targets)) return;
      if (Counted(scenes, *config).fps(p.speed->proposed->devices) < *p.targets.fps) return;
    } catch (const UserError&) {
      return;
    }
    ++out.that_do;
    std::printf("%s: area %.0f for %.0f\n", changes(p.config, *config).c_str(), area(*config).equivalent_luts(), now);
  };
  for (std::size_t down = 0; down < freeze_knob(); ++down) {
    Steps steps(knobs().size(), 0);
    steps[down] = -1;
    attempt(steps);
    for (const int depth : {1, 2}) {
      steps.assign(knobs().size(), 0);
      steps[down] = -depth;
      if (!could_do(scenes, p, steps, down)) break;
      for (std::size_t up = 0; up < freeze_knob(); ++up) {
        if (up == down) continue;
        steps[up] = 1;
        attempt(steps);
        steps[up] = 0;
      }
    }
  }
  return out;
}

TEST(ProposedSpeed, IsMetAndNoNeighbourHasLessArea) {
  const auto two = scenes();
  for (const auto& texts : {std::vector<std::string>{"psnr>=50", "max<=8", "fps>=900"}, {"psnr>=45", "fps>=300"}}) {
    const Targets targets = parse_targets(texts);
    Journal journal;
    const Proposal p = propose(two, {"shells", "fire"}, driver::load_config("base"), targets, kClock, journal, 0);
    ASSERT_TRUE(p.met()) << to_text(p);
    const Arrangement& best = *p.speed->proposed;
    EXPECT_TRUE(near_enough(two, p.config, targets));
    const double fps = Counted(two, p.config).fps(best.devices);
    EXPECT_EQ(fps, best.fps(kClock));
    EXPECT_GE(fps, *targets.fps);
    EXPECT_FALSE(cmodel::first_violation(p.config));
    const Neighbours others = arrangements(two, p), moves = widths(two, p);
    std::printf(
        "[figure] %s: %d devices of %s, %.1f fps, area %.0f (base %.0f); cheaper arrangements = %d, widths = %d, that "
        "meet the target = %d\n",
        targets.text().c_str(), best.devices, best.keys.text().c_str(), fps, best.equivalent_luts(),
        p.speed->from ? p.speed->from->equivalent_luts() : 0.0, others.tried, moves.tried,
        others.that_do + moves.that_do);
    EXPECT_GT(others.tried, 5);
    EXPECT_GT(moves.tried, 5);
    EXPECT_EQ(others.that_do + moves.that_do, 0);
  }
}

// The widths searched for the proposed arrangement, with the least area that they reach, are no cheaper than the
// result.
TEST(ProposedSpeed, AnotherRoundFindsNothingCheaper) {
  struct Question {
    const char* volume;
    std::vector<std::string> targets;
  };
  for (const auto& [volume, texts] :
       {Question{"fire:24", {"psnr>=40", "fps>=3000"}}, Question{"shells:16", {"psnr>=50", "fps>=1500"}}}) {
    scene::SceneDescription description;
    description.volume = volume;
    description.width = description.height = 64;
    std::vector<scene::Scene> one;
    one.push_back(scene::build_scene(description));
    const Targets targets = parse_targets(texts);
    const Config base = driver::load_config("base");
    Journal journal;
    const Proposal p = propose(one, {volume}, base, targets, kClock, journal, 1);
    ASSERT_TRUE(p.met()) << to_text(p);
    Simulator simulate(one, journal, 1);
    const auto price = [&](const Config& config) {
      const auto device = arranged(config, p.speed->proposed->keys);
      return device ? area(*device).equivalent_luts() : std::numeric_limits<double>::infinity();
    };
    const auto verdict = [&](const Config& config) {
      const auto entry = simulate.worst(config);
      return entry ? Verdict{targets.met(*entry), targets.excess(*entry)} : Verdict{};
    };
    const Config widths = Search(base, verdict, price).run().best;
    const auto next = SpeedSearch(one, kClock, 1).cheapest(widths, *targets.fps);
    ASSERT_TRUE(next);
    std::printf("[figure] %s, %s: area %.0f, another round %.0f\n", volume, targets.text().c_str(),
                p.speed->proposed->equivalent_luts(), next->equivalent_luts());
    EXPECT_GE(next->equivalent_luts(), p.speed->proposed->equivalent_luts());
  }
}

// With narrow words more splats vanish: base's words need twice as many devices.
TEST(ProposedSpeed, DevicesAreAsManyAsTheProposedWordsNeed) {
  scene::SceneDescription description;
  description.volume = "shells:48";
  description.width = description.height = 256;
  description.opacity_scale = 0.05;
  std::vector<scene::Scene> one;
  one.push_back(scene::build_scene(description));
  const Targets targets = parse_targets({"psnr>=50", "fps>=2000"});
  Journal journal;
  const Proposal p = propose(one, {"shells"}, driver::load_config("base"), targets, kClock, journal, 0);
  ASSERT_TRUE(p.met()) << to_text(p);
  const int devices = p.speed->proposed->devices;
  ASSERT_GT(devices, 2);
  const Counted counted(one, p.config);
  std::printf("[figure] frames a second of %d devices = %.1f (limit >= 2000), of %d = %.1f (limit < 2000)\n", devices,
              counted.fps(devices), devices - 1, counted.fps(devices - 1));
  EXPECT_GE(counted.fps(devices), 2000.0);
  EXPECT_LT(counted.fps(devices - 1), 2000.0);
}

// The estimate of a number of devices errs either way: the least is found by counting.
TEST(ProposedSpeed, OneDeviceLessIsTooSlow) {
  const auto two = scenes();
  const Config base = driver::load_config("base");
  SpeedSearch search(two, kClock, 0), by_one_thread(two, kClock, 1);
  int compared = 0;
  for (const SpeedKeys& keys : {SpeedKeys{2, 16, 16, 1, 0}, {2, 16, 16, 4, 0}, {4, 16, 16, 16, 1}, {4, 16, 16, 1, 1}}) {
    const auto config = arranged(base, keys);
    if (!config) continue;
    const Counted counted(two, *config);
    std::vector<double> rates;
    for (int devices = 1; devices <= 24; ++devices) {
      rates.push_back(counted.fps(devices));
      const int least =
          1 + static_cast<int>(std::ranges::find_if(rates, [&](double rate) { return rate >= rates.back(); }) -
                               rates.begin());
      const auto found = search.least_devices(base, keys, rates.back());
      ASSERT_TRUE(found) << keys.text() << ", " << devices;
      EXPECT_EQ(found->devices, least) << keys.text();
      const auto same = by_one_thread.least_devices(base, keys, rates.back());
      ASSERT_TRUE(same);
      EXPECT_EQ(same->devices, least) << keys.text();
      EXPECT_EQ(same->cycles, found->cycles) << keys.text();
      EXPECT_EQ(std::ranges::count(found->cycles, 0U), 0) << "a scene was not counted";
      ++compared;
    }
  }
  std::printf("[figure] numbers of devices compared = %d (limit 96)\n", compared);
  EXPECT_EQ(compared, 96);
}

TEST(ProposedSpeed, AnArrangementChangesNoPixel) {
  const auto two = scenes();
  const Config base = driver::load_config("base");
  const auto whole = driver::render(two[0], base).frame;
  const auto choices = speed_choices(base);
  int compared = 0;
  for (std::size_t i = 0; i < choices.size(); i += 7) {
    EXPECT_EQ(driver::render(two[0], *arranged(base, choices[i])).frame.words, whole.words) << choices[i].text();
    ++compared;
  }
  std::printf("[figure] arrangements compared = %d of %zu (limit > 10)\n", compared, choices.size());
  EXPECT_GT(compared, 10);
}

TEST(ProposedSpeed, OneThatCannotBeReachedIsNotMet) {
  const auto two = scenes();
  const Targets targets = parse_targets({"fps>=1e9"});
  Journal journal;
  const Proposal p = propose(two, {"shells", "fire"}, driver::load_config("base"), targets, kClock, journal, 0);
  EXPECT_TRUE(p.search.met);
  EXPECT_FALSE(p.met());
  EXPECT_NE(to_text(p).find("fps>=1e9 is not met"), std::string::npos) << to_text(p);
}

}  // namespace
}  // namespace fastsplat::analysis
