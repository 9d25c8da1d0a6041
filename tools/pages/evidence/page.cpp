// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/evidence/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace fastsplat::evidence {
namespace {

using Json = nlohmann::ordered_json;

std::optional<std::string> text(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::optional<Json> read(const std::filesystem::path& path) {
  const auto found = text(path);
  if (!found) return std::nullopt;
  return Json::parse(*found);
}

std::string missing(const char* what, const char* command) {
  return fmt::format("Missing: {}. `{}` makes it.\n\n", what, command);
}

std::string preface() {
  return text(std::filesystem::path(FASTSPLAT_SOURCE_DIR) / "tools/pages/evidence/preface.md").value_or("");
}

/// ", 2026-11-24; changed since: csr, lane": the day of a figure, and the modules of `now` that have changed or are
/// new.
std::string origin(const Json& figure, const Json& now) {
  if (!figure.contains("date")) return "; its day and RTL are not recorded";
  std::string out = ", " + figure.at("date").get<std::string>(), changed;
  if (!figure.contains("rtl") || now.is_null()) return out;
  for (const auto& [module, hash] : now.at("rtl").items())
    if (const auto& then = figure.at("rtl"); !then.contains(module) || then.at(module) != hash)
      changed += (changed.empty() ? "" : ", ") + module;
  return changed.empty() ? out : out + "; changed since: " + changed;
}

/// `now` without rtl/io, which synthesis does not read (tests/rtl/synthesis/synth.sh).
Json read_by_synthesis(Json now) {
  if (now.is_null()) return now;
  for (const Json& module : now.at("io")) now.at("rtl").erase(module.get<std::string>());
  return now;
}

/// A row per test with its figures.
std::string figures_table(const Json& json, const Json& now) {
  std::string out =
      fmt::format("{}{}.\n\n| test | figures |\n|---|---|\n", json.at("tool").get<std::string>(), origin(json, now));
  for (const auto& [test, figures] : json.at("tests").items()) {
    std::string row;
    for (const auto& [name, value] : figures.items())
      row += (row.empty() ? "" : ", ") + name + " " + value.get<std::string>();
    out += fmt::format("| {} | `{}` |\n", test, row);
  }
  return out + "\n";
}

std::string proofs_table(const Json& json, const Json& now) {
  const std::string all = json.contains("seconds")
                              ? fmt::format(" All, with covers and planted faults: {} s on {} processors.",
                                            json.at("seconds").get<int>(), json.at("processors").get<int>())
                              : "";
  std::string out = fmt::format("{}{}.{}\n\n| proved | how | seconds | planted faults refuted |\n|---|---|---|---|\n",
                                json.at("tool").get<std::string>(), origin(json, now), all);
  for (const auto& proof : json.at("proofs")) {
    out += fmt::format("| {} | {} | {:.1f} | {} |\n", proof.at("property").get<std::string>(),
                       proof.at("how").get<std::string>(), proof.at("seconds").get<double>(),
                       proof.at("refuted").get<int>());
  }
  return out + "\n";
}

constexpr const char* kKinds[] = {"lut", "carry", "mux", "ff", "lutram", "bram", "dsp"};
constexpr const char* kGateKinds[] = {"ge", "ff", "memory_bits"};
bool is_gates(const Json& design) { return design.at("family") == "gates"; }

std::string cells(const Json& of) {
  std::string out;
  for (const char* kind : kKinds) out += fmt::format(" {} |", of.at(kind).get<std::int64_t>());
  return out;
}

std::string tools(const Json& design) {
  std::string out;
  for (const auto& [name, version] : design.at("tools").items())
    out += (out.empty() ? "" : ", ") + version.get<std::string>();
  return out;
}

std::string placement(const Json& design) {
  const Json& placed = design.at("placement");
  std::string out =
      fmt::format("### {}, {}, placed\n\n{}: **{} MHz**", design.at("design").get<std::string>(),
                  design.at("family").get<std::string>(), tools(design), placed.at("fmax_mhz").get<double>());
  for (const auto& [kind, used] : placed.at("used").items())
    out += fmt::format(", {} {} of {}", kind, used.at(0).get<int>(), used.at(1).get<int>());
  if (placed.contains("bitstream_bytes"))
    out += fmt::format("; a bitstream of {} bytes", placed.at("bitstream_bytes").get<std::int64_t>());
  out += fmt::format(".\n\nThat is the fastest, seed {}, of:", placed.at("seed").get<int>());
  for (const auto& [seed, speed] : placed.at("seeds_mhz").items())
    out += fmt::format("{} {} MHz", seed == placed.at("seeds_mhz").begin().key() ? "" : ",", speed.get<double>());
  out += ".\n\n";
  const Json& slowest = placed.at("slowest");
  out += fmt::format(
      "Its slowest path, {} elements from `{}` to `{}`; the ten latest arrivals of paths that start at a register:\n\n"
      "| ns | at |\n|---|---|\n",
      slowest.at("elements").get<int>(), slowest.at("from").get<std::string>(), slowest.at("to").get<std::string>());
  for (const auto& path : placed.at("worst_paths"))
    out += fmt::format("| {:.1f} | `{}` |\n", path.at("ns").get<double>(), path.at("to").get<std::string>());
  for (const auto& path : placed.at("from_pins"))
    out += fmt::format("\nFrom a pin, where a system has its own register, the latest: {:.1f} ns at `{}`.\n",
                       path.at("ns").get<double>(), path.at("to").get<std::string>());
  return out + "\n";
}

constexpr const char* kCells = " LUT | carry | mux | FF | LUT RAM | block RAM | DSP |";

/// The devices that show the cost of each key: one without keys, and one for each key.
constexpr const char* kPlain = "plain";
constexpr std::pair<const char*, const char*> kKeys[] = {{"ellipses", "`ellipse.frac_bits = 5`"},
                                                         {"samples", "`composite.every_sample = 1`"},
                                                         {"densities", "`classify.segment_bits = 4`"},
                                                         {"cull_block", "`cull.map = \"block\"`"},
                                                         {"cull_pixel", "`cull.map = \"pixel\"`"}};

const Json* design_of(const Json& designs, const std::string& name, const std::string& family) {
  for (const Json& design : designs)
    if (design.at("design") == name && design.at("family") == family) return &design;
  return nullptr;
}

/// Differences a - b by kind of cell, with signs.
std::string more(const Json& a, const Json& b) {
  std::string out;
  for (const char* kind : kKinds)
    out += fmt::format(" {:+} |", a.at(kind).get<std::int64_t>() - b.at(kind).get<std::int64_t>());
  return out;
}

/// Cells by module, summed over its instances and sizes.
std::map<std::string, Json> by_module(const Json& design, std::span<const char* const> kinds = kKinds) {
  std::map<std::string, Json> out;
  for (const auto& [name, module] : design.at("modules").items()) {
    // Names of parametrised modules: "$paramod$HASH\\fastsplat_delay", "$paramod\\fastsplat_popcount\\BITS=...".
    const auto from = name.find("fastsplat_");
    Json& sum = out[name.substr(from, name.find('\\', from) - from)];
    if (sum.is_null()) sum = Json::object();
    for (const char* kind : kinds)
      sum[kind] = sum.value(kind, std::int64_t{0}) +
                  module.at(kind).get<std::int64_t>() * module.at("instances").get<std::int64_t>();
  }
  return out;
}

/// Cells that each key adds to the same small device: in total, and for each module that differs by more than a few.
std::string keys(const Json& designs, const std::string& family) {
  constexpr std::int64_t kFew = 8;
  const Json* plain = design_of(designs, kPlain, family);
  if (plain == nullptr) return {};
  const auto before = by_module(*plain);
  std::string table, modules;
  for (const auto& [name, key] : kKeys) {
    const Json* design = design_of(designs, name, family);
    if (design == nullptr) continue;
    table += fmt::format("| {} |{}\n", key, more(design->at("total"), plain->at("total")));
    for (const auto& [module, now] : by_module(*design)) {
      const auto found = before.find(module);
      Json then = now;
      for (const char* kind : kKinds) then[kind] = found == before.end() ? Json(0) : found->second.at(kind);
      std::int64_t differs = 0;
      for (const char* kind : kKinds)
        differs += std::abs(now.at(kind).get<std::int64_t>() - then.at(kind).get<std::int64_t>());
      if (differs > kFew)
        modules +=
            fmt::format("| {} | {} | {} |{}\n", key, module, found == before.end() ? "new" : "", more(now, then));
    }
  }
  if (table.empty()) return {};
  return fmt::format(
      "### What a key costs, {}\n\n`configs/faults/westover.toml` (2 x 2 lanes, a tile of 16 x 16) with one of its "
      "keys, compared with the same device without: additional cells. The device without:\n\n| key "
      "|{}\n|---|---|---|---|---|---|---|---|\n| none "
      "|{}\n\nWith one key:\n\n"
      "| key |{}\n|---|---|---|---|---|---|---|---|\n{}\nBy module, all its instances together:\n\n| key | "
      "module | |{}\n"
      "|---|---|---|---|---|---|---|---|---|---|\n{}\n",
      family, kCells, cells(plain->at("total")), kCells, table, kCells, modules);
}

bool names_a_key(const Json& design) {
  const auto is = [&](const char* name) { return design.at("design") == name; };
  return is(kPlain) || std::ranges::any_of(kKeys, [&](const auto& key) { return is(key.first); });
}

/// kGE and memory by module, a column pair for each device.
std::string gates(const Json& designs, const Json& read) {
  std::vector<std::map<std::string, Json>> devices;  // by module
  std::map<std::string, double> modules;  // by name, the most that a device spends on it
  std::string made, head = "| module |", rule = "|---|", sums = "| **all** |";
  for (const Json& design : designs) {
    if (!is_gates(design)) continue;
    devices.push_back(by_module(design, kGateKinds));
    for (const auto& [name, cells] : devices.back())
      modules[name] = std::max(modules[name], cells.at("ge").get<double>());
    const std::string name = design.at("design");
    made += fmt::format("- {}: {}{}; {:.0f} s\n", name, tools(design), origin(design, read),
                        design.at("seconds").get<double>());
    head += fmt::format(" {}, kGE | memory, kbit |", name);
    rule += "---:|---:|";
    const Json& total = design.at("total");
    sums += fmt::format(" **{:.1f}** | {:.1f} |", 1e-3 * total.at("ge").get<double>(),
                        1e-3 * total.at("memory_bits").get<double>());
  }
  if (devices.empty()) return {};
  std::vector<std::string> order;
  for (const auto& [name, most] : modules) order.push_back(name);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](const std::string& name) { return modules.at(name); });
  std::string rows;
  for (const std::string& module : order) {
    rows += fmt::format("| {} |", module);
    for (const auto& cells : devices) {
      const auto found = cells.find(module);
      rows += found == cells.end() ? " | |"
                                   : fmt::format(" {:.1f} | {:.1f} |", 1e-3 * found->second.at("ge").get<double>(),
                                                 1e-3 * found->second.at("memory_bits").get<double>());
    }
    rows += "\n";
  }
  return fmt::format(
      "### Gates\n\nThousand gate equivalents (four transistors each) of static CMOS gates, all instances of a module "
      "together, flip-flops included; memories as bits.\n\n{}\n{}\n{}\n{}\n{}\n",
      made, head, rule, sums, rows);
}

std::string synthesis(const Json& kept, const Json& now) {
  Json designs = Json::array();
  for (const Json& design : kept)
    if (!is_gates(design)) designs.push_back(design);
  std::string out =
      fmt::format("| design | family |{} tool, day | CPU s |\n|---|---|---|---|---|---|---|---|---|---|---|\n", kCells);
  const Json read = read_by_synthesis(now);
  for (const Json& design : designs)
    out += fmt::format("| {} | {} |{} {}{} | {:.0f} |\n", design.at("design").get<std::string>(),
                       design.at("family").get<std::string>(), cells(design.at("total")), tools(design),
                       origin(design, read), design.at("seconds").get<double>());
  out += "\n";
  for (const Json& design : designs)
    if (design.contains("placement")) out += placement(design);
  out += gates(kept, read);
  out += keys(designs, "xc7");
  for (const Json& design : designs) {
    if (!design.contains("modules") || names_a_key(design)) continue;
    out += fmt::format("### {}, {}\n\n| module | times | levels |{}\n|---|---|---|---|---|---|---|---|---|---|\n",
                       design.at("design").get<std::string>(), design.at("family").get<std::string>(), kCells);
    for (const auto& [name, module] : design.at("modules").items())
      out += fmt::format("| {} | {} | {} |{}\n", name, module.at("instances").get<int>(),
                         module.at("levels").get<int>(), cells(module));
    out += "\n";
  }
  return out;
}

/// {name: count} as code, largest first.
std::string counts(const Json& of) {
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto& [name, count] : of.items()) sorted.emplace_back(-count.get<int>(), name);
  std::sort(sorted.begin(), sorted.end());
  std::string out;
  for (const auto& [count, name] : sorted) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", name, -count);
  return out.empty() ? out : "`" + out + "`";
}

int sum(const Json& of) {
  int all = 0;
  for (const auto& [name, count] : of.items()) all += count.get<int>();
  return all;
}

/// Minutes of each target since its last finding, and a list of open findings.
std::string fuzz(const Json& json) {
  std::string open;
  for (const auto& [name, target] : json.at("targets").items())
    if (target.contains("finding"))
      open += fmt::format("- open: {}: {}\n", name, target.at("finding").get<std::string>());
  std::string out = fmt::format(
      "{}, AddressSanitizer, UndefinedBehaviorSanitizer{}. Minutes add up from version to version of the program, "
      "since a reader's last finding. {}\n\n{}| reader | processor minutes | inputs tried | edges reached |\n"
      "|---|---|---|---|\n",
      json.at("tool").get<std::string>(), origin(json, nullptr),
      open.empty() ? "No finding is open." : "Open findings:", open.empty() ? open : open + "\n");
  for (const auto& [name, target] : json.at("targets").items()) {
    out += fmt::format("| {} | {:.0f} | {} | {} |\n", name, target.at("seconds").get<double>() / 60.0,
                       target.at("runs").get<std::int64_t>(), target.at("edges").get<int>());
  }
  return out + "\n";
}

/// Results for a sample or all mutants; lists survivors. Each module's row has its own day, and "changed since" if
/// `now` has another hash.
std::string mutants(const Json& json, const Json& now) {
  std::string out = fmt::format(
      "{}.\n\n| module | mutants | killed | excluded | living | killed by | excluded because | tried |\n"
      "|---|---|---|---|---|---|---|---|\n",
      json.at("tool").get<std::string>());
  int all = 0, killed = 0, excluded = 0, living = 0;
  for (const auto& [name, module] : json.at("modules").items()) {
    const int by = sum(module.at("killed")), not_seen = sum(module.at("excluded")),
              lives = module.at("living").get<int>();
    const std::string file = name.starts_with("fastsplat_") ? name.substr(name.find('_') + 1) : name;
    std::string tried = module.value("date", "day not recorded");
    if (now.is_object() && (!module.contains("rtl") || module.at("rtl") != now.at("rtl").value(file, "")))
      tried += ", changed since";
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", name, module.at("mutants").get<int>(), by,
                       not_seen, lives, counts(module.at("killed")), counts(module.at("excluded")), tried);
    all += module.at("mutants").get<int>();
    killed += by;
    excluded += not_seen;
    living += lives;
  }
  out += fmt::format("| **all** | {} | {} | {} | {} | | | |\n\n", all, killed, excluded, living);
  out += fmt::format("Of the mutants that can be seen, **{:.2f} %** are killed.\n\n",
                     100.0 * killed / std::max(killed + living, 1));
  for (const Json& one : json.at("survivors"))
    out += fmt::format("- lives: {}, `{}`: {}, of `{}`\n", one.at("module").get<std::string>(),
                       one.at("source").get<std::string>(), one.at("what").get<std::string>(),
                       one.at("original").get<std::string>());
  return out + (json.at("survivors").empty() ? "" : "\n");
}

}  // namespace

std::string page(const std::filesystem::path& folder, const nlohmann::ordered_json& now) {
  std::string out = preface();
  out += "\n## Proofs\n\n";
  const auto proofs = read(folder / "proofs.json");
  out += proofs ? proofs_table(*proofs, now) : missing("the proofs", "tools/evidence");
  out += "## A second simulator\n\n";
  const auto icarus = read(folder / "icarus.json");
  out += icarus ? figures_table(*icarus, now) : missing("Icarus", "tools/evidence");
  out += "## The netlist\n\n";
  for (const char* name : {"tiny", "small", "tiny_ice40", "westover", "cull", "post"}) {
    const auto netlist = read(folder / (std::string("netlist_") + name + ".json"));
    out += fmt::format("### {}\n\n", name);
    out += netlist ? figures_table(*netlist, now) : missing("this netlist", "tools/netlist");
  }
  out +=
      "## Streams that break the rules\n\nEach rule that the device checks is broken in every way that a small "
      "stream has. The counts are by rule: refused at the model's beat, by the model's rule. The open tile is closed "
      "as "
      "the model closes it, and a good frame, right in every tap and cycle, follows.\n\n";
  for (const char* name : {"refusals", "refusals_base", "refusals_features"}) {
    const auto refusals = read(folder / (std::string(name) + ".json"));
    out += refusals ? figures_table(*refusals, now) : missing("such streams", "tools/evidence");
  }
  out += "## Mutants\n\n";
  const auto mutated = read(folder / "mutants.json");
  out += mutated ? mutants(*mutated, now) : missing("mutants", "tools/mutate --all");
  out += "### Model and driver\n\n";
  out += mutated && mutated->contains("cplusplus")
             ? mutants(mutated->at("cplusplus"), nullptr)
             : missing("their mutants", "tools/mutate --module cmodel --module driver");
  out += "## Files of strangers\n\n";
  const auto fuzzed = read(folder / "fuzz.json");
  out += fuzzed ? fuzz(*fuzzed) : missing("minutes of fuzzing", "tools/fuzz --keep");
  out += "## Synthesis\n\n";
  const auto designs = read(folder / "synthesis.json");
  out += designs ? synthesis(*designs, now) : missing("synthesis", "tools/synth");
  out += "## Error, cycles, area\n\n";
  const auto area = read(folder / "area.json");
  out += area ? fmt::format("Model and golden{}.\n\n{}", origin(*area, now), area->at("text").get<std::string>())
              : missing("the plan error-cycles-area", "tools/evidence");
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

}  // namespace fastsplat::evidence
