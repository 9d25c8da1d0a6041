// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/propose.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "analysis/provenance.hpp"
#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/splat_store.hpp"

namespace fastsplat::analysis {
std::uint64_t scene_hash(const scene::Scene& scene) {
  return fnv1a(content_hash(scene), scene::to_toml(scene.description));
}

Simulator::Simulator(std::vector<scene::Scene> scenes, Journal& journal, int threads)
    : scenes_(std::move(scenes)), journal_(journal), threads_(threads), golden_(scenes_.size()) {
  for (scene::Scene& scene : scenes_) {
    hashes_.push_back(scene_hash(scene));
    scene.store = std::make_shared<scene::SplatStore>(scene::usual_store_bytes() / scenes_.size());
  }
}

Journal::Entry Simulator::entry(const cmodel::Config& config, std::size_t scene, bool must) {
  const std::uint64_t hash = cmodel::config_hash(config);
  const Journal::Entry* known = journal_.find(hash, hashes_[scene]);
  if (known != nullptr && (known->has_value() || !must)) {
    ++recalled_;
    return *known;
  }
  Journal::Entry entry;
  try {
    const Image image =
        driver::to_image(driver::render(scenes_[scene], config, {.threads = threads_, .counters = false}).frame);
    if (golden_[scene].data.empty())
      golden_[scene] = golden::render(scenes_[scene], {.threads = threads_, .progress = {}, .report = nullptr});
    entry = fidelity(golden_[scene], image, threads_);
  } catch (const UserError&) {
    if (must) throw;
  }
  ++simulated_;
  journal_.add(hash, hashes_[scene], entry);
  return entry;
}

Journal::Entry Simulator::worst(const cmodel::Config& config) {
  Fidelity out;
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    const Journal::Entry one = entry(config, i, false);
    if (!one) return std::nullopt;
    out = {std::max(out.rms_lsb, one->rms_lsb), std::max(out.max_lsb, one->max_lsb)};
  }
  return out;
}

Journal::Entry Simulator::worst_drawn(const cmodel::Config& config) {
  for (std::size_t i = 0; i < scenes_.size(); ++i) entry(config, i, true);
  return worst(config);
}

bool Simulator::meets(const cmodel::Config& config, const Targets& targets) {
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    const std::size_t scene = (hardest_ + i) % scenes_.size();
    const Journal::Entry one = entry(config, scene, false);
    if (one && targets.met(*one)) continue;
    hardest_ = scene;
    return false;
  }
  return true;
}

namespace {

/// Nothing to search: any picture is good enough.
SearchOutcome as_it_is(const cmodel::Config& config) {
  SearchOutcome out;
  out.met = true;
  out.best = out.start = config;
  out.verdict = {true, 0.0};
  return out;
}

}  // namespace

Proposal propose(const std::vector<scene::Scene>& scenes, std::vector<std::string> names, const cmodel::Config& from,
                 const Targets& targets, double clock_mhz, Journal& journal, int threads, const Progress& progress) {
  Simulator simulate(scenes, journal, threads);
  Proposal out;
  out.targets = targets;
  out.from = from;
  out.scenes = std::move(names);
  out.error_from = simulate.worst_drawn(from);
  const bool other_pixels = targets.fps && std::ranges::any_of(scenes, arrangement_changes_pixels);
  const Evaluate evaluate = [&](const cmodel::Config& config) {
    const auto entry = simulate.worst(config);
    return entry ? Verdict{targets.met(*entry), targets.excess(*entry)} : Verdict{};
  };
  const auto search = [&](const cmodel::Config& begin, const Price& price) {
    if (targets.pictures.empty()) return as_it_is(begin);
    return Search(begin, evaluate, price, progress,
                  [&](const cmodel::Config& config) { return simulate.meets(config, targets); })
        .run();
  };
  if (!targets.fps) {
    out.search = search(from, [](const cmodel::Config& config) { return cost(config).total(); });
    out.config = out.search.best;
  } else {
    SpeedSearch speeds(scenes, clock_mhz, threads, progress);
    ProposedSpeed& speed = out.speed.emplace();
    speed.target = {*targets.fps, clock_mhz};
    speed.from = speeds.least_devices(from, speed_keys(from), *targets.fps);
    out.search = as_it_is(from);
    speed.proposed = speeds.cheapest(from, *targets.fps);
    // Widths and arrangement in turn, while the area falls: the area of a bit depends on the array, and the best array
    // on the widths.
    for (std::optional<Arrangement> next = std::exchange(speed.proposed, std::nullopt); next;) {
      const SpeedKeys keys = next->keys;
      const auto begin = other_pixels ? arranged(from, keys) : from;
      const SearchOutcome widths = search(begin.value_or(from), [&](const cmodel::Config& config) {
        const auto device = arranged(config, keys);
        return device ? area(*device).equivalent_luts() : std::numeric_limits<double>::infinity();
      });
      if (!speed.proposed) out.search = widths;
      if (!widths.met) {
        if (!speed.proposed) speed.proposed = next;
        break;
      }
      next = speeds.cheapest(widths.best, *targets.fps);
      // Pictures were judged with these keys.
      const auto pair =
          other_pixels && next && next->keys != keys ? speeds.least_devices(widths.best, keys, *targets.fps) : next;
      if (!pair || (speed.proposed && pair->equivalent_luts() >= speed.proposed->equivalent_luts())) break;
      out.search = widths;
      speed.proposed = pair;
      if (next->keys == keys) break;
    }
    if (out.search.met && speed.proposed) {
      for (const double rate : {0.5 * *targets.fps, 2.0 * *targets.fps}) {
        if (const auto other = speeds.cheapest(out.search.best, rate)) speed.others.emplace_back(rate, *other);
      }
    }
    out.config = out.search.best;
    if (speed.proposed) out.config = arranged(out.search.best, speed.proposed->keys).value_or(out.config);
    speed.counted = speeds.counted();
  }
  out.error = simulate.worst(other_pixels ? out.config : out.search.best);
  if (out.search.geometry) out.error_geometry = simulate.worst(*out.search.geometry);
  out.cost_from = cost(from);
  out.cost = cost(out.config);
  out.simulated = simulate.simulated();
  out.recalled = simulate.recalled();
  return out;
}

}  // namespace fastsplat::analysis
