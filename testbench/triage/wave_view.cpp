// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/wave_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace fastsplat::testbench {
namespace {

constexpr std::string_view kDut = "fastsplat_dut.", kCore = "u_top.u_core.";

struct Group {
  std::string name;
  std::vector<std::string> signals;
};

/// The group of a port of fastsplat_dut, by the beginning of its name.
std::string_view group_of(std::string_view port) {
  constexpr std::pair<std::string_view, std::string_view> kGroups[] = {{"s_t", "beats in"},
                                                                       {"m_t", "pixels out"},
                                                                       {"verdict_", "verdicts"},
                                                                       {"tap_snap_", "tap snap"},
                                                                       {"tap_w", "tap footprint"},
                                                                       {"tap_sheet_", "tap sheet"},
                                                                       {"tap_sums_", "tap sheet"},
                                                                       {"tap_composite_", "tap composite"},
                                                                       {"tap_state_", "tap composite"},
                                                                       {"tap_", "taps, all"},
                                                                       {"aw", "registers"},
                                                                       {"w", "registers"},
                                                                       {"b", "registers"},
                                                                       {"ar", "registers"},
                                                                       {"rst", "clock, reset, events"},
                                                                       {"r", "registers"}};
  for (const auto& [prefix, group] : kGroups) {
    if (port.starts_with(prefix)) return group;
  }
  return "clock, reset, events";
}

/// The unit whose ports are a group: an instance directly below the core. Empty for other instances.
std::string unit_of(const std::string& instance) {
  if (!instance.starts_with(kCore)) return {};
  const std::string unit = instance.substr(kCore.size());
  return unit.find('.') == std::string::npos ? unit : std::string{};
}

/// GTKWave's flags of a trace: 0x28 a bit in binary, 0x22 a bus in hexadecimal, right-justified.
std::string line_of(const std::string& signal) { return (signal.ends_with(']') ? "@22\n" : "@28\n") + signal + '\n'; }

std::string text_of(const Group& group, bool open) {
  std::string text = fmt::format("{}\n-{}\n", open ? "@800200" : "@c00200", group.name);
  for (const auto& signal : group.signals) text += line_of(signal);
  return text + fmt::format("{}\n-{}\n", open ? "@1000200" : "@1401200", group.name);
}

void add(std::vector<Group>& groups, const std::string& name, const std::string& signal) {
  auto group = std::ranges::find(groups, name, &Group::name);
  if (group == groups.end()) group = groups.insert(groups.end(), {.name = name, .signals = {}});
  group->signals.push_back(signal);
}

}  // namespace

std::string wave_view(const std::string& waveform, std::istream& ports, const std::optional<WaveFocus>& focus) {
  Group first{.name = focus && !focus->instance.empty() ? "look at " + focus->instance : "", .signals = {}};
  std::vector<Group> top, units;
  for (std::string signal; std::getline(ports, signal);) {
    const auto below = signal.find(kDut);
    if (below == std::string::npos) continue;
    const std::string path = signal.substr(below + kDut.size());
    // A generated block's index, "gen_lane[0].", has no dot behind it; a bus's range ends the name.
    const auto dot = path.rfind('.');
    const std::string instance = dot == std::string::npos ? "" : path.substr(0, dot);
    if (!first.name.empty() && instance == focus->instance) first.signals.push_back(signal);
    if (instance.empty()) {
      add(top, std::string(group_of(path)), signal);
    } else if (const auto unit = unit_of(instance); !unit.empty()) {
      add(units, unit, signal);
    }
  }
  // GTKWave finds the waveform by its place relative to the save file, from any folder.
  std::string text =
      fmt::format("{}\n[dumpfile] \"{}\"\n[savefile] \"{}\"\n[size] 1600 1000\n[sst_width] 250\n[signals_width] 320\n",
                  kWaveViewMark, waveform, std::filesystem::path(waveform).replace_extension(".gtkw").string());
  if (focus) {
    // A cycle begins at its rising edge (VerilatedDevice::dump). Zoom, then the marker; some cycles before it are in
    // view.
    constexpr std::uint64_t kBefore = 40;
    const std::uint64_t marker = 2 * focus->cycle + 1;
    text += fmt::format("[timestart] {}\n*-4.0 {}\n", marker - std::min(marker, kBefore), marker);
  }
  if (!first.signals.empty()) text += text_of(first, true);
  for (const auto& group : top) text += text_of(group, true);
  for (const auto& group : units) text += text_of(group, false);
  return text;
}

}  // namespace fastsplat::testbench
