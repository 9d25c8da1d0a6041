// SPDX-License-Identifier: Apache-2.0
// fastsplat_evidence: collects the results of tools other than the simulator (tools/synth, tools/evidence).
//
//   synthesis KEPT WORK_DIR FAMILY-CONFIG...
//     prints KEPT (may be missing) with the named designs renewed from synth.sh's files and, if present,
//     FAMILY-CONFIG.stamp
//   area MODEL
//     prints NAME --set KEY=VALUE... of the samples of docs/evidence/area_model.json that have no cells, or of all if
//     none lacks them: their difference from base
//   area MODEL WORK_DIR
//     prints MODEL with the cells of the samples that synth.sh has synthesised (xc7-NAME.*)
//   ratchet BASELINE WORK_DIR FAMILY-CONFIG...
//     compares with the baseline: exit code 1 if a figure moved by more than 2 %, 77 if tool versions differ
//   seed BASELINE FAMILY-CONFIG
//     prints the placer's seed of the baseline's figures; nothing if it is not placed
//   figures TOOL GTEST_JSON
//     prints the figures in a test program's report, by test
//   proofs TOOL SECONDS PROCESSORS FILE...
//     prints the proofs listed in the files
//   page FOLDER [STAMP]
//     prints docs/evidence.md from FOLDER's JSON; compares each figure's stamp with STAMP, that of today's RTL
//     (tools/helpers/evidence_stamp.py)
//
// Exit codes: 0, 1 moved, 2 usage, 3 a missing or invalid file, 77 skipped.
#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/pages/evidence/page.hpp"
#include "tools/pages/evidence/synthesis.hpp"

namespace {

using namespace fastsplat::evidence;
using Json = nlohmann::ordered_json;

/// Smallest relative change that counts as moved.
constexpr double kShare = 0.02;

Json design_of(const std::string& work, const std::string& name) {
  const auto dash = name.find('-');
  if (dash == std::string::npos) throw std::runtime_error(name + " is not a FAMILY-CONFIG");
  return read_synthesis(work, name.substr(0, dash), name.substr(dash + 1));
}

Json read_json(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  return Json::parse(in);
}

/// The entry of the same family and design.
template <class Entries>
auto find_design(Entries& entries, const Json& like) {
  return std::find_if(entries.begin(), entries.end(), [&](const Json& entry) {
    return entry.at("family") == like.at("family") && entry.at("design") == like.at("design");
  });
}

/// Prints the samples of the area model as flags, or with `work` the model with cells by module: [lut, ff, bram, dsp].
int area(Json model, const std::string& work) {
  const Json& samples = model.at("samples");
  const bool some =
      std::any_of(samples.begin(), samples.end(), [](const Json& entry) { return !entry.contains("cells"); });
  for (Json& sample : model.at("samples")) {
    const auto name = sample.at("name").get<std::string>();
    if (work.empty()) {
      if (some && sample.contains("cells")) continue;
      std::cout << name;
      for (const auto& [key, value] : sample.at("set").items())
        std::cout << " --set " << key << "=" << (value.is_string() ? value.get<std::string>() : value.dump());
      std::cout << "\n";
    } else if (std::filesystem::exists(work + "/xc7-" + name + ".stat")) {
      const Json design = read_synthesis(work, "xc7", name);
      std::map<std::string, std::vector<int>> cells;
      for (const auto& [module, found] : design.at("modules").items()) {
        const auto from = module.find("fastsplat_") + 10;
        auto& to =
            cells[module.substr(from, module.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789", from) - from)];
        to.resize(4);
        const char* const kinds[] = {"lut", "ff", "bram", "dsp"};
        for (std::size_t i = 0; i < 4; ++i) to[i] += found.at("instances").get<int>() * found.at(kinds[i]).get<int>();
      }
      sample["configuration"] = design.at("configuration");
      sample["cells"] = cells;
      model["tool"] = design.at("tools").at("yosys");
    }
  }
  if (work.empty()) return 0;
  std::cout << "{\"tool\":" << model.at("tool") << ",\n\"base\":" << model.at("base") << ",\n\"samples\":";
  const char* before = "[\n";
  for (const Json& sample : model.at("samples")) std::cout << std::exchange(before, ",\n") << sample;
  std::cout << "\n]}\n";
  return 0;
}

int ratchet(const Json& baseline, const std::string& work, std::span<const std::string> names) {
  int compared = 0;
  bool moved = false;
  for (const auto& name : names) {
    const Json now = design_of(work, name);
    const auto then = find_design(baseline, now);
    if (then == baseline.end()) throw std::runtime_error("the baseline has no " + name + ": tools/synth");
    // Other tool versions map differently, although the device is the same.
    if (then->at("tools") != now.at("tools")) {
      std::cout << "skipped: " << name << " by " << now.at("tools").dump() << ", the baseline by "
                << then->at("tools").dump() << ": tools/synth makes a new one\n";
      return 77;
    }
    for (const auto& line : changes(*then, now, kShare, compared)) {
      std::cout << line << "\n";
      moved = true;
    }
    std::cout << "[figure] " << name << " total = " << now.at("total").dump() << "\n";
  }
  std::cout << "[figure] figures compared = " << compared << " (limit > 0, each within 2 %)\n";
  if (moved) std::cout << "the device's size or depth moved; if it was meant to, tools/synth keeps the new figures\n";
  return moved || compared == 0 ? 1 : 0;
}

int seed(const Json& baseline, const std::string& name) {
  const auto dash = name.find('-');
  if (dash == std::string::npos) throw std::runtime_error(name + " is not a FAMILY-CONFIG");
  const auto kept = find_design(baseline, {{"family", name.substr(0, dash)}, {"design", name.substr(dash + 1)}});
  if (kept != baseline.end() && kept->contains("placement"))
    std::cout << kept->at("placement").at("seed").get<int>() << "\n";
  return 0;
}

/// `seconds`: total time on `processors`.
Json proofs(const std::string& tool, const std::string& seconds, const std::string& processors,
            std::span<const std::string> files) {
  Json all = Json::array();
  for (const auto& file : files) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file);
    for (std::string line; std::getline(in, line);) {
      std::vector<std::string> fields;
      for (std::size_t at = 0; at != std::string::npos;) {
        const auto bar = line.find(" | ", at);
        fields.push_back(line.substr(at, bar == std::string::npos ? bar : bar - at));
        at = bar == std::string::npos ? bar : bar + 3;
      }
      if (fields.size() != 4) throw std::runtime_error(file + " is not a list of proofs");
      all.push_back({{"property", fields[0]},
                     {"how", fields[1]},
                     {"seconds", std::stod(fields[2])},
                     {"refuted", std::stoi(fields[3])}});
    }
  }
  return {{"tool", tool}, {"seconds", std::stoi(seconds)}, {"processors", std::stoi(processors)}, {"proofs", all}};
}

Json figures(const Json& report) {
  Json out = Json::object();
  for (const auto& suite : report.at("testsuites")) {
    for (const auto& test : suite.at("testsuite")) {
      if (test.value("result", "") != "COMPLETED") continue;
      if (test.contains("failures")) throw std::runtime_error(test.at("name").get<std::string>() + " failed");
      Json values = Json::object();
      for (const auto& [key, value] : test.items()) {
        static constexpr const char* kOwn[] = {"name",      "status", "result", "timestamp",  "time",
                                               "classname", "file",   "line",   "type_param", "value_param"};
        if (std::find(std::begin(kOwn), std::end(kOwn), key) == std::end(kOwn)) values[key] = value;
      }
      if (!values.empty()) out[suite.at("name").get<std::string>() + "." + test.at("name").get<std::string>()] = values;
    }
  }
  return out;
}

int run(const std::vector<std::string>& words) {
  const auto is = [&](const char* subcommand, std::size_t least) {
    return !words.empty() && words[0] == subcommand && words.size() > least;
  };
  if (is("synthesis", 3)) {
    Json all = std::filesystem::exists(words[1]) ? read_json(words[1]) : Json::array();
    for (std::size_t i = 3; i < words.size(); ++i) {
      Json now = design_of(words[2], words[i]);
      if (const auto file = words[2] + "/" + words[i] + ".stamp"; std::filesystem::exists(file)) {
        const Json stamp = read_json(file);
        for (const char* key : {"date", "rtl"}) now[key] = stamp.at(key);
      }
      const auto then = find_design(all, now);
      if (then == all.end()) {
        all.push_back(now);
      } else {
        *then = now;
      }
    }
    const char* before = "[\n";
    for (const Json& design : all) std::cout << std::exchange(before, ",\n") << design.dump();
    std::cout << "\n]\n";
    return 0;
  }
  if (is("area", 1)) return area(read_json(words[1]), words.size() > 2 ? words[2] : "");
  if (is("ratchet", 3)) return ratchet(read_json(words[1]), words[2], std::span(words).subspan(3));
  if (is("seed", 2)) return seed(read_json(words[1]), words[2]);
  if (is("figures", 2)) {
    std::cout << Json{{"tool", words[1]}, {"tests", figures(read_json(words[2]))}}.dump(1) << "\n";
    return 0;
  }
  if (is("proofs", 4)) {
    const Json proved = proofs(words[1], words[2], words[3], std::span(words).subspan(4));
    if (proved.at("proofs").empty()) throw std::runtime_error("nothing proved in any of the files");
    std::cout << proved.dump(1) << "\n";
    return 0;
  }
  if (is("page", 1)) {
    if (!std::filesystem::is_directory(words[1])) throw std::runtime_error(words[1] + ": not a folder");
    std::cout << page(words[1], words.size() > 2 ? read_json(words[2]) : Json());
    return 0;
  }
  std::cerr << "usage: fastsplat_evidence synthesis KEPT WORK_DIR FAMILY-CONFIG... | area MODEL [WORK_DIR] | ratchet "
               "BASELINE WORK_DIR "
               "FAMILY-CONFIG... | seed BASELINE FAMILY-CONFIG | figures TOOL GTEST_JSON | proofs TOOL SECONDS "
               "PROCESSORS FILE... | page FOLDER [STAMP]\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "fastsplat_evidence: error: " << error.what() << "\n";
    return 3;
  }
}
