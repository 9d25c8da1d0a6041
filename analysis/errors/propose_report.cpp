// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/errors/propose.hpp"
#include "analysis/errors/suggestion.hpp"
#include "base/hash_text.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

std::string reached(const Proposal& proposal, const Journal::Entry& entry) {
  return entry ? proposal.target.reached(*entry) : "cannot be drawn";
}

std::string costs(const Cost& before, const Cost& after) {
  const auto part = [](const char* name, double from, double to) {
    return fmt::format("{:<12}{:>12.0f}{:>12.0f}{:>+9.1f} %\n", name, from, to, 100.0 * (to / from - 1.0));
  };
  return part("storage", before.storage_bits, after.storage_bits) +
         part("adders", before.adder_bits, after.adder_bits) +
         part("multipliers", before.multiplier_bits, after.multiplier_bits) +
         part("cost", before.total(), after.total());
}

Json entry_json(const Journal::Entry& entry) {
  if (!entry) return nullptr;
  Json json{{"psnr_db", nullptr}, {"rms_lsb8", entry->rms_lsb}, {"max_lsb8", entry->max_lsb}};
  if (std::isfinite(entry->psnr_db())) json["psnr_db"] = entry->psnr_db();
  return json;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace

std::string to_text(const Proposal& p) {
  const SearchOutcome& s = p.search;
  std::string text;
  if (!s.met) {
    text = fmt::format("{} is not met: the best result is {} ({} has {})", p.target.text, reached(p, p.error),
                       p.from.name, reached(p, p.error_from));
    if (s.geometry) {
      text += fmt::format("; {} would improve it to {}", changes(s.best, *s.geometry), reached(p, p.error_geometry));
    } else {
      text +=
          "; finer words do not help: check saturation (`fastsplat errors ranges`) and the steps (`fastsplat errors`)";
    }
    return text + "\n";
  }
  text = fmt::format("{}: {} -> {}, cost {:+.1f} %\n", p.target.text, reached(p, p.error_from), reached(p, p.error),
                     100.0 * (p.cost.total() / p.cost_from.total() - 1.0));
  const std::string changed = changes(p.from, s.best);
  text += changed.empty() ? "nothing to change\n" : changed + "\n";
  text += fmt::format("{:<24}{:>9}{:>9}{:>10}   {}\n", "key", "from", "alone", "proposed", "at one less");
  for (const KeyOutcome& key : s.keys) {
    text += fmt::format("{:<24}{:>9}{:>9}{:>10}   {}\n", key.key, key.from, key.alone, key.proposed,
                        key.lower.empty() ? "(minimum)"
                        : key.dearer      ? fmt::format("{}: costs more", key.lower)
                        : std::isfinite(key.lowered.excess)
                            ? fmt::format("{}: {:.3f} of the allowed error", key.lower, key.lowered.excess)
                            : fmt::format("{}: cannot be drawn", key.lower));
  }
  text += fmt::format("{:<12}{:>12}{:>12}\n", "", "from", "proposed") + costs(p.cost_from, p.cost);
  return text + fmt::format("{} configurations evaluated: {} frames simulated, {} recalled\n", s.evaluated,
                            p.simulated, p.recalled);
}

Json to_json(const Proposal& p) {
  const SearchOutcome& s = p.search;
  Json json{{"schema", "fastsplat.proposal/1"},
            {"target", p.target.text},
            {"met", s.met},
            {"scenes", p.scenes},
            {"from", {{"name", p.from.name}, {"hash", hash_text(cmodel::config_hash(p.from))}}},
            {"error_from", entry_json(p.error_from)},
            {"error", entry_json(p.error)},
            {"cost_from", to_json(p.cost_from)},
            {"cost", to_json(p.cost)},
            {"hash", hash_text(cmodel::config_hash(s.best))},
            {"changes", changes(p.from, s.best)},
            {"keys", Json::array()}};
  for (const KeyOutcome& key : s.keys) {
    json["keys"].push_back({{"key", key.key},
                            {"from", key.from},
                            {"alone", key.alone},
                            {"proposed", key.proposed},
                            {"lower", key.lower},
                            {"excess_if_lower", number(key.lowered.excess)}});
  }
  if (s.geometry)
    json["would_help"] = {{"changes", changes(s.best, *s.geometry)}, {"error", entry_json(p.error_geometry)}};
  json["judged"] = s.evaluated;
  json["simulated"] = p.simulated;
  json["recalled"] = p.recalled;
  return json;
}

}  // namespace fastsplat::analysis
