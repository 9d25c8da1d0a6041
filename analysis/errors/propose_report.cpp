// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/errors/propose.hpp"
#include "analysis/errors/suggestion.hpp"
#include "base/frame_rate.hpp"
#include "base/hash_text.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

std::string reached(const Proposal& proposal, const Journal::Entry& entry) {
  return entry ? proposal.targets.reached(*entry) : "cannot be drawn";
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

std::string rates(const Proposal& p, const Arrangement& arrangement) {
  const double clock = p.speed->target.clock_mhz;
  std::string text = fmt::format("{:>14}{:>10}{:>9}  scene\n", "cycles", "ms", "fps");
  for (std::size_t i = 0; i < arrangement.cycles.size(); ++i) {
    const std::uint64_t cycles = arrangement.cycles[i];
    text += fmt::format("{:>14}{:>10.3f}{:>9.2f}  {}\n", cycles, frame_milliseconds(cycles, clock),
                        frames_per_second(cycles, clock), p.scenes[i]);
  }
  return text;
}

std::string area_row(const std::string& name, const Arrangement& a) {
  const double n = a.devices;
  return fmt::format("{:<10}{:>8}{:>11.0f}{:>11.0f}{:>8.0f}{:>8.0f}{:>12.0f}  {}\n", name, a.devices, n * a.area.lut,
                     n * a.area.ff, 0.5 * n * a.area.half_bram, n * a.area.dsp, a.equivalent_luts(), a.keys.text());
}

/// What all devices take, beside the configuration that the search began with and other rates.
std::string speeds(const Proposal& p) {
  const ProposedSpeed& s = *p.speed;
  std::string text =
      fmt::format("frames a second at {:g} MHz, devices with culling fetch from a memory of {} cycles:\n",
                  s.target.clock_mhz, kFetchLatency) +
      rates(p, *s.proposed);
  text += fmt::format("{:<10}{:>8}{:>11}{:>11}{:>8}{:>8}{:>12}\n", "", "devices", "LUT", "FF", "RAMB36", "DSP",
                      "equal LUTs");
  if (s.from) text += area_row("from", *s.from);
  text += area_row("proposed", *s.proposed);
  for (const auto& [fps, other] : s.others) text += area_row(fmt::format("{:g} fps", fps), other);
  return text;
}

Json arrangement_json(const Arrangement& a, double clock_mhz) {
  return {{"devices", a.devices},
          {"array_lanes", a.keys.lanes},
          {"tile_width", a.keys.tile_width},
          {"tile_height", a.keys.tile_height},
          {"composited_at_once", a.keys.composited},
          {"cull_map", a.keys.cull_text()},
          {"cycles", a.cycles},
          {"fps", a.fps(clock_mhz)},
          {"milliseconds", frame_milliseconds(a.slowest(), clock_mhz)},
          {"area",
           {{"lut", a.devices * a.area.lut},
            {"ff", a.devices * a.area.ff},
            {"ramb36", 0.5 * a.devices * a.area.half_bram},
            {"dsp", a.devices * a.area.dsp},
            {"equivalent_luts", a.equivalent_luts()}}}};
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
  if (s.met && p.speed && !p.speed->proposed)
    return fmt::format("{} is not met: {} devices of no array and tile draw so many frames\n", p.targets.text(),
                       kMostDevices);
  if (!s.met) {
    text = fmt::format("{} is not met: the best result is {} ({} has {})", p.targets.text(), reached(p, p.error),
                       p.from.name, reached(p, p.error_from));
    if (s.geometry) {
      text += fmt::format("; {} would improve it to {}", changes(s.best, *s.geometry), reached(p, p.error_geometry));
    } else {
      text +=
          "; finer words do not help: check saturation (`fastsplat errors ranges`) and the steps (`fastsplat errors`)";
    }
    return text + "\n";
  }
  text = fmt::format("{}: ", p.targets.text());
  if (!p.targets.pictures.empty()) text += reached(p, p.error_from) + " -> " + reached(p, p.error) + ", ";
  const auto change = [](const char* what, double from, double to) {
    return fmt::format("{} {:+.1f} %\n", what, 100.0 * (to / from - 1.0));
  };
  if (!p.speed) {
    text += change("cost", p.cost_from.total(), p.cost.total());
  } else {
    const Arrangement& best = *p.speed->proposed;
    text += fmt::format("{:.2f} fps with {}", best.fps(p.speed->target.clock_mhz),
                        best.devices == 1 ? "1 device" : fmt::format("{} devices", best.devices));
    text += p.speed->from ? change(", area", p.speed->from->equivalent_luts(), best.equivalent_luts()) : "\n";
  }
  const std::string changed = changes(p.from, p.config);
  text += changed.empty() ? "nothing to change\n" : changed + "\n";
  if (p.speed) text += speeds(p);
  if (!s.keys.empty())
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
            {"target", p.targets.text()},
            {"met", p.met()},
            {"scenes", p.scenes},
            {"from", {{"name", p.from.name}, {"hash", hash_text(cmodel::config_hash(p.from))}}},
            {"error_from", entry_json(p.error_from)},
            {"error", entry_json(p.error)},
            {"cost_from", to_json(p.cost_from)},
            {"cost", to_json(p.cost)},
            {"hash", hash_text(cmodel::config_hash(p.config))},
            {"changes", changes(p.from, p.config)},
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
  if (p.speed) {
    const double clock = p.speed->target.clock_mhz;
    const auto of = [&](const std::optional<Arrangement>& a) {
      return a ? arrangement_json(*a, clock) : Json(nullptr);
    };
    json["speed"] = {{"fps", p.speed->target.fps},        {"clock_mhz", clock},
                     {"fetch_latency", kFetchLatency},    {"from", of(p.speed->from)},
                     {"proposed", of(p.speed->proposed)}, {"others", Json::array()},
                     {"counted", p.speed->counted}};
    for (const auto& [fps, other] : p.speed->others) {
      json["speed"]["others"].push_back(arrangement_json(other, clock));
      json["speed"]["others"].back()["target_fps"] = fps;
    }
  }
  json["judged"] = s.evaluated;
  json["simulated"] = p.simulated;
  json["recalled"] = p.recalled;
  return json;
}

}  // namespace fastsplat::analysis
