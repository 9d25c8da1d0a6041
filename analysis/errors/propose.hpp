// SPDX-License-Identifier: Apache-2.0
// Finds the cheapest configuration that meets a target on all given scenes when simulated (docs/errors.md, section 6).
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/errors/cost.hpp"
#include "analysis/errors/journal.hpp"
#include "analysis/errors/search.hpp"
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

  /// The worst of all scenes by the target's figure; empty if one cannot be drawn.
  Journal::Entry worst(const cmodel::Config& config, const Target& target);
  /// The same, but throws UserError if a scene cannot be drawn.
  Journal::Entry worst_drawn(const cmodel::Config& config, const Target& target);
  /// Whether every scene meets the target. Stops at the first that does not, and begins there the next time.
  bool meets(const cmodel::Config& config, const Target& target);

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

struct Proposal {
  Target target;
  cmodel::Config from;
  SearchOutcome search;
  std::vector<std::string> scenes;
  /// The worst of the scenes by the target's figure.
  Journal::Entry error_from, error;
  Journal::Entry error_geometry;  ///< of search.geometry, if present
  Cost cost_from, cost;
  int simulated = 0, recalled = 0;
};

/// Throws UserError if `from` cannot draw a scene. `names`: of the scenes.
Proposal propose(const std::vector<scene::Scene>& scenes, std::vector<std::string> names, const cmodel::Config& from,
                 const Target& target, Journal& journal, int threads, const Progress& progress = {});

std::string to_text(const Proposal& proposal);
nlohmann::ordered_json to_json(const Proposal& proposal);

}  // namespace fastsplat::analysis
