// The cheapest configuration that is good enough, found by asking what each candidate does (docs/errors.md, "Propose").
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
  /// Error over the error that is allowed; infinite where the configuration cannot draw the scene.
  double excess = std::numeric_limits<double>::infinity();
};
/// Called once per configuration.
using Judge = std::function<Verdict(const cmodel::Config&)>;
/// Verdict::meets alone, for which less work may do: one failed scene says no.
using Check = std::function<bool(const cmodel::Config&)>;
/// To be made small; of two equally cheap ones that with fewer bits is taken.
using Price = std::function<double(const cmodel::Config&)>;

/// A key as it ended.
struct KeyOutcome {
  const char* key = "";
  std::string from, alone, proposed;  ///< alone: the least that met the target with all other keys as they began
  std::string lower;                  ///< what it would be one step lower; empty where nothing is lower
  bool dearer = false;                ///< that would cost more
  Verdict lowered;                    ///< otherwise the verdict on that step alone: it does not meet the target
};

struct SearchOutcome {
  bool met = false;
  cmodel::Config best;  ///< or what came nearest
  Verdict verdict;
  cmodel::Config start;                    ///< met the target, and the descent began there: `from` or finer
  std::vector<KeyOutcome> keys;            ///< in the order of knobs(); empty where not met
  std::optional<cmodel::Config> geometry;  ///< where not met: what of the kept keys would bring it nearer
  Verdict geometry_verdict;
  int judged = 0;
};

/// Deterministic: the same answers of the judge give the same outcome.
class Search {
 public:
  /// `check`: absent, the judge is called.
  Search(const cmodel::Config& from, Judge judge, Price price, Progress progress = {}, Check check = {});
  SearchOutcome run();

 private:
  /// Nothing for what no configuration is.
  std::optional<Verdict> judge(const Steps& steps);
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
  SearchOutcome told(const Steps& steps);

  cmodel::Config from_;
  Judge judge_;
  Price price_;
  Progress progress_;
  Check check_;
  std::map<std::uint64_t, Verdict> known_;  ///< by configuration hash
  std::set<std::uint64_t> failed_;          ///< hashes that were checked and not judged
  Steps begin_, lowest_, nearest_;          ///< the start; per knob the least that meets alone; least excess so far
  double nearest_excess_ = std::numeric_limits<double>::infinity();
  NoiseModel noises_;
};

}  // namespace fastsplat::analysis
