// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace fastsplat::analysis {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Most steps by which all keys get finer: after that, nothing else helps.
constexpr int kMostRaised = 6;
/// Typical number of configurations in a search; for the progress shown.
constexpr std::size_t kUsual = 200;

double square(double x) { return x * x; }

std::string text(const cmodel::Config& config, const Knob& knob) {
  return cmodel::text_of(config, *cmodel::find_key(knob.key));
}

}  // namespace

Search::Search(const cmodel::Config& from, Evaluate evaluate, Price price, Progress progress, Check check)
    : from_(from),
      evaluate_(std::move(evaluate)),
      price_(std::move(price)),
      progress_(std::move(progress)),
      check_(std::move(check)) {}

void Search::report_progress() const {
  const std::size_t evaluated = known_.size() + failed_.size();
  if (progress_) progress_(evaluated, std::max(kUsual, evaluated + 1));
}

std::optional<Verdict> Search::evaluate(const Steps& steps) {
  const auto config = turned(from_, steps);
  if (!config) return std::nullopt;
  const auto [found, fresh] = known_.try_emplace(cmodel::config_hash(*config));
  if (fresh) {
    found->second = evaluate_(*config);
    failed_.erase(found->first);
    report_progress();
  }
  if (found->second.excess < nearest_excess_) nearest_ = steps, nearest_excess_ = found->second.excess;
  return found->second;
}

bool Search::meets(const Steps& steps) {
  const auto config = turned(from_, steps);
  if (!config) return false;
  const std::uint64_t hash = cmodel::config_hash(*config);
  if (check_ && !known_.contains(hash)) {
    if (failed_.contains(hash)) return false;
    if (!check_(*config)) {
      failed_.insert(hash);
      report_progress();
      return false;
    }
  }
  return evaluate(steps)->meets;
}

double Search::price(const Steps& steps) const {
  const auto config = turned(from_, steps);
  return config ? price_(*config) : kInfinite;
}

/// `from`, or all keys finer by as little as necessary. Early termination gets later only if nothing else helps.
std::optional<Steps> Search::start() {
  Steps steps(knobs().size(), 0);
  nearest_ = steps;
  if (evaluate(steps)->meets) return steps;  // counts, too: it may be the nearest of all
  for (const int freeze : {0, 2, 20}) {
    if (freeze > 0 && from_.freeze_below == 0) break;
    steps.assign(knobs().size(), 0);
    steps[freeze_knob()] = freeze;
    double before = kInfinite;
    int idle = 0;
    for (int raised = 0; raised < kMostRaised && idle < 2; ++raised) {
      bool moved = freeze > 0 && raised == 0;
      for (std::size_t k = 0; k < freeze_knob(); ++k) {
        ++steps[k];
        if (turned(from_, steps)) {
          moved = true;
        } else {
          --steps[k];
        }
      }
      if (!moved) break;
      const auto verdict = evaluate(steps);
      if (verdict && verdict->meets) return steps;
      const double excess = verdict ? verdict->excess : kInfinite;
      idle = excess < 0.99 * before ? 0 : idle + 1;
      before = std::min(before, excess);
    }
  }
  return std::nullopt;
}

/// Lowers each knob alone from the start, by bisection: errors grow as bits go.
void Search::lowest_alone(const Steps& start) {
  begin_ = start;
  lowest_ = start;
  noises_ = NoiseModel(start, evaluate(start)->excess);
  for (std::size_t k = 0; k < knobs().size(); ++k) {
    Steps steps = start;
    const auto possible = [&](int step) {
      steps[k] = step;
      return turned(from_, steps).has_value();
    };
    int good = start[k], bad = start[k] - 1;
    while (possible(bad)) --bad;
    for (int stride = 1; good - bad > 1;) {
      // Near the start first, in growing strides: few keys can go far down.
      const int middle = std::max(good - stride, bad + 1);
      steps[k] = middle;
      const auto verdict = evaluate(steps);
      noises_.learn(k, middle, verdict->excess);
      if (verdict->meets) {
        good = middle;
        stride = std::min(2 * stride, std::max(1, (good - bad) / 2));
      } else {
        bad = middle;
        stride = std::max(1, (good - bad) / 2);
      }
    }
    lowest_[k] = good;
  }
}

/// Under the model: from the least of each knob up, each time the step that removes most noise for its price.
Steps Search::cheapest_by_model(double budget) const {
  Steps steps = lowest_;
  while (noises_.square(steps) > budget) {
    const double now = price(steps);
    double best = -1.0;
    std::size_t which = steps.size();
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (steps[k] >= begin_[k]) continue;
      Steps finer = steps;
      ++finer[k];
      const double gain = noises_.added(k, steps[k]) - noises_.added(k, finer[k]);
      // The least of all together may be an invalid configuration, which is left first.
      const double more = std::isfinite(now) ? price(finer) - now : 1.0;
      if (!std::isfinite(more)) continue;
      const double worth = gain / std::max(more, 1e-3);
      if (worth > best) best = worth, which = k;
    }
    if (which == steps.size()) return begin_;
    ++steps[which];
  }
  return steps;
}

/// Tries the model's proposals, adjusting the budget until they just meet the target.
Steps Search::combine(const Steps& start) {
  Steps best = start;
  double price_of_best = price(start), passes = 0.0, fails = 0.0, budget = 1.0;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Steps steps = cheapest_by_model(budget);
    const auto verdict = evaluate(steps);
    if (verdict && verdict->meets) {
      passes = budget;
      if (price(steps) < price_of_best) best = steps, price_of_best = price(steps);
    } else {
      fails = budget;
    }
    const double excess = verdict ? verdict->excess : 2.0;
    if (passes > 0.0 && fails > 0.0) {
      if (fails - passes < 0.03 * fails) break;
      budget = 0.5 * (passes + fails);
    } else {
      budget /= std::clamp(square(excess), passes > 0.0 ? 0.5 : 1.1, passes > 0.0 ? 0.9 : 10.0);
    }
  }
  return best;
}

/// Lowers single knobs, the largest saving first, as long as the target is met. A failed knob is not tried again before
/// the end: with less of the others it would not do better. At the end all are tried: none can be lowered alone.
Steps Search::descend(Steps steps) {
  std::vector<bool> hopeless(steps.size(), false);
  for (bool last = false;;) {
    const double now = price(steps);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      Steps lower = steps;
      --lower[k];
      // Fewer segments leave longer remainders to multiply: a dearer step does not count as lower.
      if (!hopeless[k] && turned(from_, lower) && price(lower) <= now) order.emplace_back(price(lower) - now, k);
    }
    std::ranges::stable_sort(order, {}, [](const auto& entry) { return entry.first; });
    bool moved = false;
    for (const auto& [saved, k] : order) {
      Steps lower = steps;
      --lower[k];
      if (meets(lower)) {
        steps = lower;
        moved = true;
        last = false;
        break;
      }
      hopeless[k] = true;
    }
    if (moved) continue;
    if (last) return steps;
    hopeless.assign(steps.size(), false);
    last = true;
  }
}

/// All knobs but one a step finer, as far as the configuration stays valid.
Steps Search::finer_by_one(Steps steps, std::size_t but) const {
  for (std::size_t k = 0; k < freeze_knob(); ++k) {
    if (k == but) continue;
    ++steps[k];
    if (!turned(from_, steps)) --steps[k];
  }
  return steps;
}

/// One knob down by one or two steps and another up by one: the cheapest such pair that meets the target and is cheaper
/// than `steps`. A step down that fails with all other knobs finer fails with any one of them, because errors grow as
/// bits go. All other pairs are tried.
std::optional<Steps> Search::exchange(const Steps& steps) {
  const double now = price(steps);
  struct Candidate {
    double price;
    Steps steps;
  };
  std::vector<Candidate> candidates;
  for (std::size_t down = 0; down < freeze_knob(); ++down) {
    for (const int depth : {1, 2}) {
      Steps lower = steps;
      lower[down] -= depth;
      std::vector<Candidate> cheaper;
      for (std::size_t up = 0; up < freeze_knob(); ++up) {
        Steps both = lower;
        ++both[up];
        if (up != down && price(both) < now) cheaper.push_back({price(both), both});
      }
      if (cheaper.empty()) continue;
      if (!meets(finer_by_one(lower, down))) break;  // two steps down do not do better than one
      std::ranges::move(cheaper, std::back_inserter(candidates));
    }
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::price);
  for (const Candidate& candidate : candidates) {
    if (meets(candidate.steps)) return candidate.steps;
  }
  return std::nullopt;
}

SearchOutcome Search::outcome(const Steps& steps) {
  SearchOutcome out;
  out.met = true;
  out.best = *turned(from_, steps);
  out.verdict = *evaluate(steps);
  out.start = *turned(from_, begin_);
  for (std::size_t k = 0; k < knobs().size(); ++k) {
    const Knob& knob = knobs()[k];
    Steps alone = begin_, lower = steps;
    alone[k] = lowest_[k];
    --lower[k];
    KeyOutcome key{knob.key, text(from_, knob), text(*turned(from_, alone), knob), text(out.best, knob), {}, false, {}};
    if (const auto config = turned(from_, lower)) {
      key.lower = text(*config, knob);
      key.dearer = price(lower) > price(steps);
      if (!key.dearer) key.lowered = *evaluate(lower);
    }
    out.keys.push_back(std::move(key));
  }
  out.evaluated = static_cast<int>(known_.size() + failed_.size());
  return out;
}

SearchOutcome Search::run() {
  const auto start = this->start();
  if (!start) {
    SearchOutcome out;
    out.best = *turned(from_, nearest_);
    out.verdict = {false, nearest_excess_};
    cmodel::Config wider = out.best;
    wider.rlut_sets = std::min(64, 2 * wider.rlut_sets);
    wider.rlut_columns = std::min(1024, 2 * wider.rlut_columns);
    wider.position_int_bits = std::min(16, wider.position_int_bits + 1);
    if (!cmodel::first_violation(wider)) {
      out.geometry_verdict = evaluate_(wider);
      if (out.geometry_verdict.excess < 0.98 * nearest_excess_) out.geometry = wider;
    }
    out.evaluated = static_cast<int>(known_.size() + failed_.size());
    return out;
  }
  lowest_alone(*start);
  Steps steps = descend(combine(*start));
  while (const auto cheaper = exchange(steps)) steps = descend(*cheaper);
  return outcome(steps);
}

}  // namespace fastsplat::analysis
