// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/evidence/synthesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <stdexcept>

namespace fastsplat::evidence {
namespace {

using Json = nlohmann::ordered_json;
using Cells = std::map<std::string, std::int64_t>;

constexpr const char* kClasses[] = {"lut", "carry", "mux", "ff", "lutram", "bram", "dsp"};

/// Class of a primitive; empty for other cells (inverters, which LUTs absorb; buffers; submodules).
std::string class_of(const std::string& cell) {
  static const std::pair<std::regex, const char*> table[] = {
      {std::regex("LUT[1-6]|SB_LUT4"), "lut"},
      {std::regex("CARRY4|CCU2C|SB_CARRY"), "carry"},
      {std::regex("MUXF[789]|PFUMX|L6MUX21"), "mux"},
      {std::regex("FD[RSCP]E(_1)?|TRELLIS_FF|SB_DFF.*"), "ff"},
      {std::regex("RAM(32|64|128|256).*|TRELLIS_DPR16X4|SRL.*"), "lutram"},
      {std::regex("RAMB(18|36)E1|DP16KD|SB_RAM40_4K.*"), "bram"},
      {std::regex("DSP48E1|MULT18X18D|SB_MAC16"), "dsp"},
  };
  for (const auto& [pattern, name] : table) {
    if (std::regex_match(cell, pattern)) return name;
  }
  return {};
}

/// Transistors of a gate of static CMOS, as Yosys counts them; 0 for other cells.
int transistors(const std::string& cell) {
  static const std::map<std::string, int> table{{"$_NOT_", 2},  {"$_NAND_", 4}, {"$_NOR_", 4},   {"$_AOI3_", 6},
                                                {"$_OAI3_", 6}, {"$_AOI4_", 8}, {"$_OAI4_", 8},  {"$_NMUX_", 10},
                                                {"$_MUX_", 12}, {"$_XOR_", 12}, {"$_XNOR_", 12}, {"$_DFF_P_", 16}};
  const auto found = table.find(cell);
  return found == table.end() ? 0 : found->second;
}
constexpr int kNand = 4;  ///< transistors of a gate equivalent

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Reads "=== NAME ===" and the "TYPE N" lines below it; the hierarchy's own tree and totals are under "design
/// hierarchy".
std::map<std::string, Cells> read_stat(const std::filesystem::path& path) {
  static const std::regex heading(R"(=== (.*) ===)"), entry(R"( +(\S+) +(\d+))");
  std::map<std::string, Cells> modules;
  Cells* current = nullptr;
  bool cells = false;
  std::smatch match;
  for (const auto& line : lines_of(path)) {
    if (std::regex_match(line, match, heading)) {
      current = &modules[match[1]];
      cells = false;
    } else if (line.find("Number of cells:") != std::string::npos) {
      cells = true;
    } else if (cells && current != nullptr && std::regex_match(line, match, entry)) {
      (*current)[match[1]] += std::stoll(match[2]);
    }
  }
  if (modules.empty()) throw std::runtime_error(path.string() + " contains no statistics");
  return modules;
}

bool is_memory(const std::string& module) {
  return module.ends_with("\\fastsplat_ram_1r1w") || module == "fastsplat_ram_1r1w";
}

void add_cells(const std::map<std::string, Cells>& modules, const std::string& name, std::int64_t times, Cells& to) {
  for (const auto& [cell, count] : modules.at(name)) {
    if (const std::string kind = class_of(cell); !kind.empty()) to[kind] += times * count;
    if (is_memory(cell)) add_cells(modules, cell, times * count, to);
  }
}

/// "Number of memory bits" by module.
Cells read_memories(const std::filesystem::path& path) {
  static const std::regex heading(R"(=== (.*) ===)"), entry(R"( +Number of memory bits: +(\d+))");
  Cells bits;
  std::string name;
  std::smatch match;
  for (const auto& line : lines_of(path)) {
    if (std::regex_match(line, match, heading))
      name = match[1];
    else if (std::regex_match(line, match, entry))
      bits[name] = std::stoll(match[1]);
  }
  return bits;
}

/// Transistors, flip-flops, and bits of memories, of a module without its submodules but memories.
void add_gates(const Cells& cells, const Cells& memories, std::int64_t times, Cells& to) {
  for (const auto& [cell, count] : cells) {
    to["transistors"] += times * count * transistors(cell);
    if (cell == "$_DFF_P_") to["ff"] += times * count;
    if (is_memory(cell)) to["memory_bits"] += times * count * memories.at(cell);
  }
}

Json gates_json(const Cells& cells) {
  const auto of = [&](const char* kind) { return cells.contains(kind) ? cells.at(kind) : std::int64_t{0}; };
  return {{"ge", of("transistors") / kNand}, {"ff", of("ff")}, {"memory_bits", of("memory_bits")}};
}

void count_instances(const std::map<std::string, Cells>& modules, const std::string& name, std::int64_t times,
                     Cells& to) {
  to[name] += times;
  for (const auto& [cell, count] : modules.at(name))
    if (modules.contains(cell)) count_instances(modules, cell, times * count, to);
}

Json to_json(const Cells& cells) {
  Json json = Json::object();
  for (const char* kind : kClasses) json[kind] = cells.contains(kind) ? cells.at(kind) : 0;
  return json;
}

std::map<std::string, int> read_levels(const std::filesystem::path& path) {
  static const std::regex found(R"(Longest topological path in (\S+) \(length=(\d+)\):)");
  std::map<std::string, int> levels;
  std::smatch match;
  for (const auto& line : lines_of(path))
    if (std::regex_match(line, match, found)) levels[match[1]] = std::stoi(match[2]);
  return levels;
}

/// "u_core.u_compositor.touched_q_SB_DFFESR_Q_95_D_SB_LUT4_O_LC": returns the register after which a cell was named.
std::string short_name(const std::string& cell) { return cell.substr(0, cell.find("_SB_")); }

/// The latest arrivals at registers from registers (`from` is "posedge") or pins ("<async>"), latest first.
Json latest_arrivals(const Json& report, const char* from, std::size_t count) {
  std::vector<std::pair<double, std::string>> ends;
  const auto is = [](const Json& event, const char* what) { return event.get<std::string>().starts_with(what); };
  for (const auto& net : report.at("detailed_net_timings")) {
    if (!is(net.at("event"), from)) continue;
    for (const auto& end : net.at("endpoints"))
      if (is(end.at("event"), "posedge"))
        ends.emplace_back(end.at("delay").get<double>(), end.at("cell").get<std::string>());
  }
  std::sort(ends.begin(), ends.end(), std::greater<>());
  Json out = Json::array();
  for (std::size_t i = 0; i < ends.size() && out.size() < count; ++i)
    out.push_back({{"ns", std::round(ends[i].first * 10) / 10}, {"to", short_name(ends[i].second)}});
  return out;
}

/// Reads nextpnr's report: utilisation, fmax, the slowest path, the ten latest arrivals.
Json read_placement(const std::filesystem::path& report) {
  std::ifstream in(report);
  if (!in) throw std::runtime_error("cannot read " + report.string());
  const Json from = Json::parse(in);
  Json to = Json::object();
  for (const auto& [clock, speed] : from.at("fmax").items())
    to["fmax_mhz"] = std::round(speed.at("achieved").get<double>() * 10) / 10;
  for (const char* kind : {"ICESTORM_LC", "ICESTORM_RAM", "SB_IO", "SB_GB"}) {
    const auto& used = from.at("utilization").at(kind);
    to["used"][kind] = Json::array({used.at("used"), used.at("available")});
  }
  for (const auto& path : from.at("critical_paths")) {
    const auto from_what = path.at("from").get<std::string>();
    if (!from_what.starts_with("posedge") || path.at("to") != from_what) continue;  // by a pin
    const auto& steps = path.at("path");
    to["slowest"] = {{"elements", steps.size()},
                     {"from", short_name(steps.front().at("to").at("cell"))},
                     {"to", short_name(steps.back().at("to").at("cell"))}};
  }
  to["worst_paths"] = latest_arrivals(from, "posedge", 10);
  to["from_pins"] = latest_arrivals(from, "<async>", 1);
  return to;
}

void compare(const std::string& where, const Json& then, const Json& now, double share, int& compared,
             std::vector<std::string>& out) {
  for (const auto& [key, value] : then.items()) {
    // A bitstream exists only with icepack, and its length is that of the part.
    static constexpr const char* kNoFigures[] = {"seconds",   "worst_paths", "from_pins", "slowest",
                                                 "seeds_mhz", "date",        "rtl",       "bitstream_bytes"};
    if (std::find(std::begin(kNoFigures), std::end(kNoFigures), key) != std::end(kNoFigures)) continue;
    const std::string place = where + " " + key;
    if (!now.contains(key)) {
      out.push_back(place + ": gone");
    } else if (value.is_object()) {
      compare(place, value, now.at(key), share, compared, out);
    } else if (value.is_array()) {
      compare(place, Json{{"used", value.at(0)}}, Json{{"used", now.at(key).at(0)}}, share, compared, out);
    } else if (value.is_number()) {
      ++compared;
      const double a = value.get<double>(), b = now.at(key).get<double>();
      // In small counts, one cell more can exceed the share.
      if (std::abs(b - a) > std::max(share * std::abs(a), 1.0))
        out.push_back(fmt::format("{}: {} -> {} ({:+.1f} %)", place, a, b, a == 0 ? 100.0 : 100.0 * (b - a) / a));
    } else if (value != now.at(key)) {
      out.push_back(fmt::format("{}: {} -> {}", place, value.dump(), now.at(key).dump()));
    }
  }
  for (const auto& [key, value] : now.items())
    if (!then.contains(key)) out.push_back(where + " " + key + ": new");
}

}  // namespace

Json read_synthesis(const std::filesystem::path& work, const std::string& family, const std::string& config) {
  const std::string base = (work / (family + "-" + config)).string();
  const auto modules = read_stat(base + ".stat");
  const auto levels = read_levels(base + ".levels");
  Json json{{"design", config}, {"family", family}};
  double seconds = 0;
  std::int64_t bitstream = 0;
  Json seeds = Json::object();  // MHz by seed of the placer
  for (const auto& line : lines_of(base + ".tools")) {
    const auto space = line.find(' ');
    if (line.starts_with("seconds ")) {
      seconds = std::stod(line.substr(space));
    } else if (line.starts_with("bitstream ")) {
      bitstream = std::stoll(line.substr(space));
    } else if (line.starts_with("seed ")) {
      const auto speed = line.find(' ', space + 1);
      seeds[line.substr(space + 1, speed - space - 1)] = std::round(std::stod(line.substr(speed)) / 100) / 10;
    } else if (line.starts_with("configuration ")) {
      json["configuration"] = line.substr(space + 1);
    } else {
      json["tools"][line.substr(0, space)] = line.substr(space + 1);
    }
  }
  const bool whole = modules.contains("ice40_whole"), flat = whole || modules.contains("ice40_wrap");
  const std::string top = whole ? "ice40_whole" : flat ? "ice40_wrap" : "fastsplat_core";
  const bool gates = family == "gates";
  const Cells memories = gates ? read_memories(base + ".memories") : Cells{};
  const auto add = [&](const std::string& name, std::int64_t times, Cells& to) {
    if (gates)
      add_gates(modules.at(name), memories, times, to);
    else
      add_cells(modules, name, times, to);
  };
  const auto json_of = [&](const Cells& cells) { return gates ? gates_json(cells) : to_json(cells); };
  Cells instances, total;
  count_instances(modules, top, 1, instances);
  for (const auto& [name, times] : instances)
    if (!is_memory(name)) add(name, times, total);
  json["total"] = json_of(total);
  if (!flat) {
    for (const auto& [name, times] : instances) {
      if (is_memory(name)) continue;
      Cells own;
      add(name, 1, own);
      Json module{{"instances", times}, {"levels", levels.contains(name) ? levels.at(name) : 0}};
      module.update(json_of(own));
      json["modules"][name] = module;
    }
  }
  if (family == "hx8k") {
    json["placement"] = read_placement(base + ".report");
    const auto fastest = std::max_element(seeds.begin(), seeds.end());  // the first of equals, which is kept
    if (fastest == seeds.end()) throw std::runtime_error(base + ".tools contains no seed of the placer");
    json["placement"]["seed"] = std::stoi(fastest.key());
    json["placement"]["seeds_mhz"] = seeds;
  }
  if (bitstream > 0) json["placement"]["bitstream_bytes"] = bitstream;
  json["seconds"] = std::round(seconds);
  return json;
}

std::vector<std::string> changes(const Json& then, const Json& now, double share, int& compared) {
  std::vector<std::string> out;
  compare(then.at("family").get<std::string>() + " " + then.at("design").get<std::string>(), then, now, share, compared,
          out);
  return out;
}

}  // namespace fastsplat::evidence
