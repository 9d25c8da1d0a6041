#include "analysis/errors/propose.hpp"

#include <algorithm>
#include <utility>

#include "analysis/provenance.hpp"
#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"

namespace fastsplat::analysis {
namespace {

/// Of the scenes, the one with the largest excess; nothing where one could not be drawn.
Journal::Entry worst(const std::vector<Journal::Entry>& entries, const Target& target) {
  Journal::Entry out = Fidelity{};
  for (const Journal::Entry& entry : entries) {
    if (!entry) return std::nullopt;
    if (target.excess(*entry) >= target.excess(*out)) out = entry;
  }
  return out;
}

}  // namespace

std::uint64_t scene_hash(const scene::Scene& scene) {
  return fnv1a(content_hash(scene), scene::to_toml(scene.description));
}

Simulator::Simulator(const std::vector<scene::Scene>& scenes, Journal& journal, int threads)
    : scenes_(scenes), journal_(journal), threads_(threads), golden_(scenes.size()) {
  for (const scene::Scene& scene : scenes) hashes_.push_back(scene_hash(scene));
}

std::vector<Journal::Entry> Simulator::operator()(const cmodel::Config& config, const Target& target, bool must) {
  const std::uint64_t hash = cmodel::config_hash(config);
  std::vector<Journal::Entry> out;
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    const Journal::Entry* known = journal_.find(hash, hashes_[i]);
    if (known != nullptr && (known->has_value() || !must)) {
      ++recalled_;
      out.push_back(*known);
    } else {
      Journal::Entry entry;
      try {
        const Image image =
            driver::to_image(driver::render(scenes_[i], config, {.threads = threads_, .progress = {}}).frame);
        if (golden_[i].data.empty())
          golden_[i] = golden::render(scenes_[i], {.threads = threads_, .progress = {}, .report = nullptr});
        entry = fidelity(golden_[i], image, threads_);
      } catch (const UserError&) {
        if (must) throw;
      }
      ++simulated_;
      journal_.add(hash, hashes_[i], entry);
      out.push_back(entry);
    }
    if (!must && (!out.back() || !target.met(*out.back()))) break;
  }
  return out;
}

Proposal propose(const std::vector<scene::Scene>& scenes, std::vector<std::string> names, const cmodel::Config& from,
                 const Target& target, Journal& journal, int threads, const Progress& progress) {
  Simulator simulate(scenes, journal, threads);
  Proposal out;
  out.target = target;
  out.from = from;
  out.scenes = std::move(names);
  out.error_from = worst(simulate(from, target, true), target);
  const Judge judge = [&](const cmodel::Config& config) {
    const auto entry = worst(simulate(config, target), target);
    return entry ? Verdict{target.met(*entry), target.excess(*entry)} : Verdict{};
  };
  Search search(
      from, judge, [](const cmodel::Config& config) { return cost(config).total(); }, progress);
  out.search = search.run();
  out.error = worst(simulate(out.search.best, target), target);
  if (out.search.geometry) out.error_geometry = worst(simulate(*out.search.geometry, target), target);
  out.cost_from = cost(from);
  out.cost = cost(out.search.best);
  out.simulated = simulate.simulated();
  out.recalled = simulate.recalled();
  return out;
}

}  // namespace fastsplat::analysis
