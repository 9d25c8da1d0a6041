// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::cli {
namespace {

constexpr std::size_t kNamedParts = 4;  ///< of the energy

/// "12.3 to 45.6 uJ", or mJ.
std::string range(const analysis::Joules& joules) {
  const bool small = joules.high < 1e-3;
  const double unit = small ? 1e6 : 1e3;
  return fmt::format("{:.3g} to {:.3g} {}", unit * joules.low, unit * joules.high, small ? "uJ" : "mJ");
}

std::string energy_text(const FrameTraffic& traffic) {
  if (!traffic.energy_violation.empty()) return "energy: not estimated: " + traffic.energy_violation + "\n";
  const analysis::Joules all = analysis::total(traffic.energy);
  auto parts = traffic.energy;
  std::ranges::stable_sort(parts, std::ranges::greater{}, [](const auto& part) { return part.joules.high; });
  std::string text = fmt::format("energy: {}, without clock, registers and leakage:", range(all));
  for (std::size_t i = 0; i < std::min(kNamedParts, parts.size()); ++i)
    text += fmt::format("{} {} {}", i == 0 ? "" : ",", parts[i].name, range(parts[i].joules));
  return text + "\n";
}

}  // namespace

std::uint64_t FrameTraffic::bytes_in() const { return in.total() * cmodel::kBeatBytes; }

std::string to_text(const FrameTraffic& traffic) {
  std::string text = fmt::format("stream: {} bytes", grouped(traffic.bytes_in()));
  char sign = ':';
  traffic.in.for_each([&](const char* name, std::uint64_t beats) {
    const double share = 100.0 * ratio(beats, traffic.in.total());
    if (share < 0.05) return;
    text += fmt::format("{} {} {:.1f} %", sign, name, share);
    if (traffic.drawn && name == std::string_view("splats") && *traffic.drawn > 0)
      text += fmt::format(" ({:.2f} records each)", ratio(beats, *traffic.drawn));
    sign = ',';
  });
  return text + fmt::format("; pixels: {} bytes\n", grouped(traffic.bytes_out)) + energy_text(traffic);
}

nlohmann::ordered_json traffic_json(const FrameTraffic& traffic) {
  nlohmann::ordered_json json{{"bytes_in", traffic.bytes_in()}, {"bytes_out", traffic.bytes_out}};
  traffic.in.for_each([&](const char* name, std::uint64_t beats) { json["in"][name] = beats * cmodel::kBeatBytes; });
  if (traffic.drawn) json["records_each"] = ratio(traffic.in.splats, *traffic.drawn);
  return json;
}

}  // namespace fastsplat::cli
