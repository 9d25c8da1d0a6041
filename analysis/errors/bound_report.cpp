// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "analysis/error_values.hpp"
#include "analysis/errors/attribution.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMeaning[] = {"the scene and the configuration", "also positions, weights and depths",
                                    "every word of the driver"};

/// Terms by their mean, the largest first, without zeros.
std::vector<Term> ranked(const Bound& bound) {
  std::vector<Term> terms;
  for (std::size_t t = 0; t < kTermCount; ++t) {
    if (bound.mean[t] > 0.0) terms.push_back(static_cast<Term>(t));
  }
  std::ranges::stable_sort(terms, [&](Term a, Term b) {
    return bound.mean[static_cast<std::size_t>(a)] > bound.mean[static_cast<std::size_t>(b)];
  });
  return terms;
}

}  // namespace

bool BoundReport::holds() const {
  return std::ranges::all_of(levels, [](const BoundResult& level) { return level.check.over == 0; });
}

BoundReport bounds(const stages::Chain& chain, int threads, const Progress& progress) {
  BoundReport out{chain(stages::Mixture{}, threads), chain(stages::Mixture::all_device(), threads), {}};
  for (const Known known : kLevels) {
    // The effect of an unknown position on a circle's weight is derived for the RLUT only.
    if (known == Known::Scene && chain.gaussians() == nullptr && chain.config().index() != cmodel::IndexKind::Rlut)
      continue;
    BoundResult level{known, bound(chain, out.real, known, threads), {}};
    level.check = check(level.bound, out.real, out.device);
    out.levels.push_back(std::move(level));
    if (progress) progress(out.levels.size(), kLevels.size());
  }
  return out;
}

std::string to_text(const BoundReport& report, int bits) {
  const double unit = lsb_per_unit(bits);
  const BoundCheck& first = report.levels.front().check;
  std::string text =
      report.holds() ? fmt::format("no error exceeds its bound at any level: {} values, greatest error {:.3f} LSB{}\n",
                                   first.values, first.greatest_error * unit, bits)
                     : "A BOUND IS VIOLATED: an error of the device exceeds its proved bound\n";
  text += fmt::format("{:<9} {:<34} {:>8} | {:>8} {:>8} {:>8} | {:>8} {:>11}\n", "known", "", "greatest", "median",
                      "p90", "p99", "over", "error/bound");
  for (const auto& [known, bound, check] : report.levels)
    text += fmt::format("{:<9} {:<34} {:>8.3f} | {:>7.1f}x {:>7.1f}x {:>7.1f}x | {:>8} {:>11.4f}\n", to_string(known),
                        kMeaning[static_cast<std::size_t>(known)], check.greatest_bound * unit, check.median, check.p90,
                        check.p99, check.over, check.worst);
  text +=
      "median, p90, p99: bound / error in the largest channel of each pixel with an error; below: shares of the mean "
      "bound\n";
  for (const auto& level : report.levels) {
    const double sum = std::reduce(level.bound.mean.begin(), level.bound.mean.end());
    text += fmt::format("{:<9}", to_string(level.known));
    for (const Term term : ranked(level.bound)) {
      const double share = level.bound.mean[static_cast<std::size_t>(term)] / sum;
      if (share >= 0.01) text += fmt::format(" {} {:.0f} %", to_string(term), 100.0 * share);
    }
    text += "\n";
  }
  return text;
}

Json to_json(const BoundReport& report) {
  Json json{{"schema", "fastsplat.bound/1"}, {"holds", report.holds()}};
  for (const auto& [known, bound, check] : report.levels) {
    Json level{{"known", to_string(known)},
               {"values", check.values},
               {"over", check.over},
               {"greatest_error_to_bound", check.worst},
               {"pixels_with_error", check.pixels},
               {"bound_to_error", {{"median", check.median}, {"p90", check.p90}, {"p99", check.p99}}},
               {"greatest_bound_lsb8", check.greatest_bound * lsb_per_unit(8)},
               {"greatest_error_lsb8", check.greatest_error * lsb_per_unit(8)},
               {"dominant", to_string(bound.dominant())}};
    for (std::size_t t = 0; t < kTermCount; ++t)
      level["mean_lsb8"][to_string(static_cast<Term>(t))] = bound.mean[t] * lsb_per_unit(8);
    json["levels"].push_back(level);
  }
  return json;
}

}  // namespace fastsplat::analysis
