// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/propose.hpp"

#include <algorithm>
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

Journal::Entry Simulator::worst(const cmodel::Config& config, const Target& target) {
  Journal::Entry out = Fidelity{};
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    const Journal::Entry one = entry(config, i, false);
    if (!one) return std::nullopt;
    if (target.excess(*one) >= target.excess(*out)) out = one;
  }
  return out;
}

Journal::Entry Simulator::worst_drawn(const cmodel::Config& config, const Target& target) {
  for (std::size_t i = 0; i < scenes_.size(); ++i) entry(config, i, true);
  return worst(config, target);
}

bool Simulator::meets(const cmodel::Config& config, const Target& target) {
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    const std::size_t scene = (hardest_ + i) % scenes_.size();
    const Journal::Entry one = entry(config, scene, false);
    if (one && target.met(*one)) continue;
    hardest_ = scene;
    return false;
  }
  return true;
}

Proposal propose(const std::vector<scene::Scene>& scenes, std::vector<std::string> names, const cmodel::Config& from,
                 const Target& target, Journal& journal, int threads, const Progress& progress) {
  Simulator simulate(scenes, journal, threads);
  Proposal out;
  out.target = target;
  out.from = from;
  out.scenes = std::move(names);
  out.error_from = simulate.worst_drawn(from, target);
  const Evaluate evaluate = [&](const cmodel::Config& config) {
    const auto entry = simulate.worst(config, target);
    return entry ? Verdict{target.met(*entry), target.excess(*entry)} : Verdict{};
  };
  Search search(
      from, evaluate, [](const cmodel::Config& config) { return cost(config).total(); }, progress,
      [&](const cmodel::Config& config) { return simulate.meets(config, target); });
  out.search = search.run();
  out.error = simulate.worst(out.search.best, target);
  if (out.search.geometry) out.error_geometry = simulate.worst(*out.search.geometry, target);
  out.cost_from = cost(from);
  out.cost = cost(out.search.best);
  out.simulated = simulate.simulated();
  out.recalled = simulate.recalled();
  return out;
}

}  // namespace fastsplat::analysis
