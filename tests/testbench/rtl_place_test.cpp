// SPDX-License-Identifier: Apache-2.0
// The instance that a failure names is in the RTL, and is of the named module.
#include "testbench/triage/rtl_place.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/cmodel/configs_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::testbench {
namespace {

/// Sources of the modules by name; empty for other names.
std::string source_of(const std::string& module) {
  static const std::map<std::string, std::string> sources = [] {
    std::map<std::string, std::string> all;
    for (const char* folder : {"rtl", "testbench/module"})
      for (const auto& entry :
           std::filesystem::recursive_directory_iterator(std::filesystem::path(FASTSPLAT_SOURCE_DIR) / folder))
        if (entry.path().extension() == ".sv")
          all[entry.path().stem()] = (std::ostringstream() << std::ifstream(entry.path()).rdbuf()).str();
    return all;
  }();
  const auto found = sources.find(module);
  return found == sources.end() ? std::string() : found->second;
}

/// The module of an instance below fastsplat_dut; empty if a part of its path is not in the source.
std::string module_at(const std::string& instance) {
  std::string module = "fastsplat_dut", source = source_of(module), part;
  for (std::stringstream parts(instance); std::getline(parts, part, '.');) {
    const std::string name = part.substr(0, part.find('['));
    std::smatch match;
    if (source.find("begin : " + name) != std::string::npos) continue;
    if (!std::regex_search(source, match, std::regex("(fastsplat_\\w+)[^;]*\\b" + name + " \\("))) return {};
    // The name of the nearest module before the instance's.
    const std::string before = match.prefix().str() + match.str();
    const std::regex word("fastsplat_(?!pkg)\\w+");
    for (std::sregex_iterator it(before.begin(), before.end(), word), end; it != end; ++it)
      if (!source_of(it->str()).empty()) module = it->str();
    source = source_of(module);
  }
  return module;
}

TEST(RtlPlace, IsAnInstanceOfItsModule) {
  std::set<std::string> modules;
  std::map<std::string, std::string> checked;  // instances
  int places = 0;
  for (const char* name : {"tiny", "base", "faults/mustfail", "faults/post", "ellipse"}) {
    const cmodel::Config config = test::named_config(name);
    for (int tap = 0; tap < cmodel::kTapCount; ++tap)
      for (const std::size_t word : {0U, 1U, 7U}) {
        TapCopy at{.tap = static_cast<cmodel::Tap>(tap), .x = -3, .y = 5, .payload = std::vector<std::uint32_t>(16)};
        for (const Divergence& divergence :
             {Divergence{.model = at, .rtl = at, .word = word}, Divergence{.model = at, .rtl = {}},
              Divergence{.model = at, .rtl = at, .word = 16, .header = true}}) {
          const RtlPlace place = rtl_place(config, divergence, 1);
          const auto [known, added] = checked.try_emplace(place.instance);
          if (added) known->second = module_at(place.instance);
          EXPECT_EQ(known->second, place.module) << place.instance;
          modules.insert(place.module);
          ++places;
        }
      }
  }
  std::printf("[figure] places = %d, modules = %zu (limit 7)\n", places, modules.size());
  EXPECT_EQ(modules.size(), 7U);
}

// Bank (row, column) of pixel (x, y) is (y mod P, x mod P); the halo shifts it.
TEST(RtlPlace, NamesThePixelsBank) {
  const cmodel::Config config = test::named_config("tiny");  // two lanes a side
  TapCopy at{.tap = cmodel::Tap::Sheet, .x = -1, .y = 2, .payload = std::vector<std::uint32_t>(16)};
  const auto instance = [&](std::size_t word, int halo) {
    return rtl_place(config, {.model = at, .rtl = at, .word = word}, halo).instance;
  };
  EXPECT_EQ(instance(0, 0), "u_top.u_core.u_splat.gen_row[0].gen_bank[1].u_bank");
  EXPECT_EQ(instance(4, 0), "u_top.u_core.u_splat.gen_row[0].gen_bank[0].u_bank");
  EXPECT_EQ(instance(15, 0), "u_top.u_core.u_splat.gen_row[1].gen_bank[0].u_bank");
  EXPECT_EQ(instance(0, 1), "u_top.u_core.u_splat.gen_row[1].gen_bank[0].u_bank");
}

}  // namespace
}  // namespace fastsplat::testbench
