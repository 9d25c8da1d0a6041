// SPDX-License-Identifier: Apache-2.0
// Searches for the cheapest configuration that is good enough, checking each candidate (docs/errors.md, section 6).
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/errors/knobs.hpp"
#include "analysis/errors/noise_model.hpp"
#include "base/progress.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

struct Verdict {
  bool meets = false;
  /// Error / allowed error; infinite if the configuration cannot draw the scene.
  double excess = std::numeric_limits<double>::infinity();
};
/// Called once per configuration.
using Evaluate = std::function<Verdict(const cmodel::Config&)>;
/// Verdict::meets alone, which may take less work: one failed scene decides.
using Check = std::function<bool(const cmodel::Config&)>;
/// To be minimised; of two equally cheap configurations the one with fewer bits is taken.
using Price = std::function<double(const cmodel::Config&)>;

/// The outcome of a key.
struct KeyOutcome {
  const char* key = "";
  std::string from, alone, proposed;  ///< alone: the least that met the target with all other keys at their start
  std::string lower;                  ///< its value one step lower; empty at the minimum
  bool dearer = false;                ///< the lower step would cost more
  Verdict lowered;                    ///< otherwise the verdict on that step alone: it does not meet the target
};

struct SearchOutcome {
  bool met = false;
  cmodel::Config best;  ///< if not met, the nearest one
  Verdict verdict;
  cmodel::Config start;                    ///< where the descent began; met the target: `from` or finer
  std::vector<KeyOutcome> keys;            ///< in the order of knobs(); empty if not met
  std::optional<cmodel::Config> geometry;  ///< if not met: a change of the kept keys that would bring it nearer
  Verdict geometry_verdict;
  int evaluated = 0;
};

/// Deterministic: the same verdicts give the same outcome.
class Search {
 public:
  /// Without `check`, `evaluate` is called.
  Search(const cmodel::Config& from, Evaluate evaluate, Price price, Progress progress = {}, Check check = {});
  SearchOutcome run();

 private:
  /// nullopt for an invalid configuration.
  std::optional<Verdict> evaluate(const Steps& steps);
  bool meets(const Steps& steps);
  void report_progress() const;
  double price(const Steps& steps) const;

  std::optional<Steps> start();
  void lowest_alone(const Steps& start);
  Steps cheapest_by_model(double budget) const;
  Steps combine(const Steps& start);
  Steps descend(Steps steps);
  Steps finer_by_one(Steps steps, std::size_t but) const;
  std::optional<Steps> exchange(const Steps& steps);
  SearchOutcome outcome(const Steps& steps);

  cmodel::Config from_;
  Evaluate evaluate_;
  Price price_;
  Progress progress_;
  Check check_;
  std::map<std::uint64_t, Verdict> known_;  ///< by configuration hash
  std::set<std::uint64_t> failed_;          ///< hashes that failed the check and were not evaluated
  Steps begin_, lowest_, nearest_;          ///< the start; per knob the least that meets alone; least excess so far
  double nearest_excess_ = std::numeric_limits<double>::infinity();
  NoiseModel noises_;
};

}  // namespace fastsplat::analysis
