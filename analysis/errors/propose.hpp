// SPDX-License-Identifier: Apache-2.0
// Finds the cheapest configuration that meets all targets on all given scenes when simulated, and how many devices of
// which arrangement are fast enough (docs/errors.md, section 6).
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/errors/cost.hpp"
#include "analysis/errors/journal.hpp"
#include "analysis/errors/search.hpp"
#include "analysis/errors/speed.hpp"
#include "analysis/errors/target.hpp"
#include "base/image.hpp"
#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace fastsplat::analysis {

/// Compares device and golden over some scenes. Golden is drawn once per scene, and only if a simulation needs it.
class Simulator {
 public:
  /// Keeps a reference to the journal.
  Simulator(std::vector<scene::Scene> scenes, Journal& journal, int threads);

  /// The greatest errors of all scenes; empty if one cannot be drawn.
  Journal::Entry worst(const cmodel::Config& config);
  /// The same, but throws UserError if a scene cannot be drawn.
  Journal::Entry worst_drawn(const cmodel::Config& config);
  /// Whether every scene meets the targets. Stops at the first that does not, and begins there the next time.
  bool meets(const cmodel::Config& config, const Targets& targets);

  int simulated() const { return simulated_; }  ///< frames drawn
  int recalled() const { return recalled_; }    ///< frames the journal knew

 private:
  Journal::Entry entry(const cmodel::Config& config, std::size_t scene, bool must);

  std::vector<scene::Scene> scenes_;
  Journal& journal_;
  int threads_;
  std::vector<std::uint64_t> hashes_;
  std::vector<Image> golden_;  ///< empty ones are not drawn yet
  std::size_t hardest_ = 0;    ///< the scene that failed last
  int simulated_ = 0, recalled_ = 0;
};

/// Hash of everything that decides a scene's picture.
std::uint64_t scene_hash(const scene::Scene& scene);

/// Of a target of frames a second.
struct ProposedSpeed {
  SpeedTarget target;
  std::optional<Arrangement> from;      ///< of the configuration that the search began with, as it is arranged
  std::optional<Arrangement> proposed;  ///< empty if the target is not met
  std::vector<std::pair<double, Arrangement>> others;  ///< the least area for half and for twice the rate
  int counted = 0;                                     ///< frames whose cycles were counted
};

struct Proposal {
  Targets targets;
  cmodel::Config from;
  cmodel::Config config;  ///< the result: search.best, arranged for the speed
  SearchOutcome search;   ///< of the widths, arranged as `from`
  std::optional<ProposedSpeed> speed;
  std::vector<std::string> scenes;
  /// The greatest errors of the scenes.
  Journal::Entry error_from, error;
  Journal::Entry error_geometry;  ///< of search.geometry, if present
  Cost cost_from, cost;           ///< of one device
  int simulated = 0, recalled = 0;

  bool met() const { return search.met && (!speed || speed->proposed); }
};

/// Throws UserError if `from` cannot draw a scene. `names`: of the scenes. With targets.fps, `clock_mhz` is that of the
/// devices, and the least area of all devices together is sought; else the least cost of one.
Proposal propose(const std::vector<scene::Scene>& scenes, std::vector<std::string> names, const cmodel::Config& from,
                 const Targets& targets, double clock_mhz, Journal& journal, int threads,
                 const Progress& progress = {});

std::string to_text(const Proposal& proposal);
nlohmann::ordered_json to_json(const Proposal& proposal);

}  // namespace fastsplat::analysis
