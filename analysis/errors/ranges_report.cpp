// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/errors/derived_ranges.hpp"
#include "analysis/errors/ranges.hpp"
#include "base/hash_text.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

const char* name(const SiteRange& site) { return cmodel::facts(site.site).name; }

std::string words(const Need& need) {
  std::string text = fmt::format("{} {} -> {} would {}: {}", need.key, need.has, need.needs,
                                 need.needs > need.has ? "avoid saturation" : "suffice", need.why);
  if (need.possible != need.needs) {
    const bool least = need.needs < need.has;
    text += need.possible == need.has ? fmt::format("; but not possible: {}", need.limit)
                                      : fmt::format("; {} is the {} possible: {} it {}", need.possible,
                                                    least ? "least" : "most", least ? "below" : "above", need.limit);
  }
  return text + "\n";
}

/// Shares by leading bit, in tenths of the largest one; '.': none.
std::string bars(const SiteRange& site) {
  if (site.histogram.empty()) return "only zeros";
  std::uint64_t most = 0;
  for (const auto& [weight, count] : site.histogram) most = std::max(most, count);
  const int top = site.histogram.front().first, last = site.histogram.back().first;
  std::string text(static_cast<std::size_t>(top - last) + 1, '.');
  for (const auto& [weight, count] : site.histogram)
    text[static_cast<std::size_t>(top - weight)] =
        static_cast<char>('0' + static_cast<int>(9.0 * static_cast<double>(count) / static_cast<double>(most)));
  return fmt::format("2^{} {} 2^{}", top, text, last);
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Json lost_json(const Lost& lost) { return {{"mean_ulp", lost.mean}, {"rms_ulp", lost.rms}}; }

Json site_json(const SiteRange& site) {
  Json histogram = Json::array();
  for (const auto& [weight, count] : site.histogram) histogram.push_back({{"weight", weight}, {"values", count}});
  return {{"site", name(site)},
          {"format", site.format},
          {"rounding", site.rounding},
          {"dropped_bits", site.dropped_bits},
          {"values", site.values},
          {"zeros", site.zeros},
          {"least", site.least},
          {"greatest", site.greatest},
          {"inexact", site.inexact},
          {"saturated", site.saturated},
          {"lost", lost_json(site.lost)},
          {"theory", lost_json(site.theory)},
          {"unused_head_bits", site.head},
          {"idle_tail_bits", site.tail},
          {"missing_bits", site.missing},
          {"histogram", histogram}};
}

/// The simulated range of a site; null if no value passed it.
const SiteRange* simulated(const RangesReport& report, cmodel::Site site) {
  const auto found =
      std::find_if(report.sites.begin(), report.sites.end(), [&](const SiteRange& one) { return one.site == site; });
  return found == report.sites.end() ? nullptr : &*found;
}

std::string derived_text(const RangesReport& report) {
  std::string text = fmt::format("{:<14}{:<8}{:<22}{:<18}{:<12}{}\n", "site", "word", "these scenes", "any scene",
                                 "verdict", "largest value of any scene");
  for (const DerivedRange& range : derived_ranges(report.config)) {
    const cmodel::Narrowing narrowing = cmodel::narrowing(report.config, range.site);
    const SiteRange* seen = simulated(report, range.site);
    text +=
        fmt::format("{:<14}{:<8}{:<22}{:<18}{:<12}{}\n", cmodel::facts(range.site).name, format_text(narrowing.to()),
                    seen == nullptr ? "-" : fmt::format("{:.6g}..{:.6g}", seen->least, seen->greatest),
                    interval_text(range.least, range.greatest, narrowing.from_frac()), verdict(range), range.formula);
  }
  return text;
}

Json derived_json(const RangesReport& report, const DerivedRange& range) {
  const cmodel::Narrowing narrowing = cmodel::narrowing(report.config, range.site);
  const auto value = [&](std::int64_t word) { return std::ldexp(static_cast<double>(word), -narrowing.from_frac()); };
  Json json{{"site", cmodel::facts(range.site).name},
            {"format", format_text(narrowing.to())},
            {"least", value(range.least)},
            {"greatest", value(range.greatest)},
            {"formula", range.formula},
            {"verdict", to_string(range.width)},
            {"unused_head_bits", range.spare},
            {"simulated", nullptr}};
  if (const SiteRange* seen = simulated(report, range.site)) json["simulated"] = Json{seen->least, seen->greatest};
  return json;
}

}  // namespace

std::string to_text(const RangesReport& report) {
  std::string text;
  for (const Need& need : report.needs) {
    if (need.needs != need.has) text += words(need);
  }
  if (text.empty()) text = "every signal has the width that these scenes need\n";
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    const driver::DriverReport& scene = report.scenes[i];
    if (scene.vanished_voxels + scene.saturated_voxels + scene.saturated_records == 0) continue;
    text += fmt::format("{}: of {} voxels {} vanished ({:.3g} % of colour and opacity), {} and {} records saturated\n",
                        report.names[i], scene.voxels, scene.vanished_voxels, 100.0 * scene.vanished_share,
                        scene.saturated_voxels, scene.saturated_records);
  }
  text +=
      fmt::format("{:<14}{:<8}{:>5}{:>14}{:>9}{:>13}{:>10}{:>10}{:>9}{:>9}{:>10}{:>6}{:>6}\n", "site", "word", "drops",
                  "values", "inexact", "greatest", "mean lost", "theory", "RMS", "theory", "saturated", "head", "tail");
  for (const SiteRange& site : report.sites) {
    text += fmt::format(
        "{:<14}{:<8}{:>5}{:>14}{:>7.1f} %{:>13.6g}{:>+10.4f}{:>+10.4f}{:>9.4f}{:>9.4f}{:>10}{:>6}{:>6}\n", name(site),
        site.format, site.dropped_bits, site.values, 100.0 * share(site.inexact, site.values), site.greatest,
        site.lost.mean, site.theory.mean, site.lost.rms, site.theory.rms, site.saturated, site.head, site.tail);
  }
  text +=
      "(lost: word minus value, in units of the last place; head: leading bits never used; tail: trailing bits always "
      "0)\n";
  text += derived_text(report);
  text += "magnitudes by leading bit, in tenths of the most frequent one:\n";
  for (const SiteRange& site : report.sites)
    text += fmt::format("{:<14}{}, {:.1f} % are 0\n", name(site), bars(site), 100.0 * share(site.zeros, site.values));
  return text;
}

Json to_json(const RangesReport& report) {
  Json json{{"schema", "fastsplat.ranges/1"},
            {"config", {{"name", report.config.name}, {"hash", hash_text(cmodel::config_hash(report.config))}}}};
  for (std::size_t i = 0; i < report.scenes.size(); ++i) {
    const driver::DriverReport& scene = report.scenes[i];
    json["scenes"].push_back({{"scene", report.names[i]},
                              {"voxels", scene.voxels},
                              {"vanished_voxels", scene.vanished_voxels},
                              {"vanished_share", scene.vanished_share},
                              {"saturated_voxels", scene.saturated_voxels},
                              {"saturated_records", scene.saturated_records}});
  }
  json["needs"] = Json::array();
  for (const Need& need : report.needs) {
    json["needs"].push_back({{"key", need.key},
                             {"has", need.has},
                             {"needs", need.needs},
                             {"possible", need.possible},
                             {"why", need.why},
                             {"limit", need.limit}});
  }
  json["sites"] = Json::array();
  for (const SiteRange& site : report.sites) json["sites"].push_back(site_json(site));
  for (const DerivedRange& range : derived_ranges(report.config))
    json["derived"].push_back(derived_json(report, range));
  report.counters.for_each(
      [&](const char* counter, std::uint64_t value, const char*) { json["counters"][counter] = value; });
  return json;
}

}  // namespace fastsplat::analysis
