// SPDX-License-Identifier: Apache-2.0
// libfastsplat exports the functions of its headers and no others, and needs no library that a bench does not use.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "testbench/capi/fastsplat.h"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  char part[4096];
  while (const std::size_t got = fread(part, 1, sizeof part, pipe)) out.append(part, got);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return out;
}

std::set<std::string> declared() {
  std::set<std::string> names;
  for (const char* header : {"fastsplat.h", "fastsplat_dpi.h"}) {
    std::ifstream in(std::string(FASTSPLAT_SOURCE_DIR "/testbench/capi/") + header);
    std::ostringstream text;
    text << in.rdbuf();
    const std::string all = text.str();
    const std::regex function(R"(FASTSPLAT_API [^;(]*?(fastsplat_\w+)\()");
    for (std::sregex_iterator it(all.begin(), all.end(), function), end; it != end; ++it) names.insert((*it)[1]);
  }
  return names;
}

TEST(CapiSymbols, ShowsExactlyWhatItsHeadersDeclare) {
  std::istringstream lines(output_of("nm -D --defined-only '" FASTSPLAT_LIBRARY "'"));
  std::set<std::string> shown, versions;
  for (std::string line; std::getline(lines, line);) {
    const std::string kind = line.substr(17, 1), name = line.substr(19, line.find('@') - 19);
    (kind == "A" ? versions : shown).insert(name);
  }
  std::printf("[figure] symbols = %zu (limit > 30)\n", shown.size());
  EXPECT_GT(shown.size(), 30u);
  EXPECT_EQ(shown, declared());
  EXPECT_EQ(versions, (std::set<std::string>{"FASTSPLAT_" + std::to_string(FASTSPLAT_API_MAJOR)}));
}

TEST(CapiSymbols, NeedsNoPictureVolumeOrSimulator) {
  const std::string dynamic = output_of("readelf -d '" FASTSPLAT_LIBRARY "'");
  EXPECT_NE(dynamic.find("soname: [libfastsplat.so.3]"), std::string::npos);
  const std::regex needed(R"(NEEDED.*\[(.*?)\])");
  int libraries = 0;
  for (std::sregex_iterator it(dynamic.begin(), dynamic.end(), needed), end; it != end; ++it, ++libraries) {
    const std::string name = (*it)[1];
    EXPECT_TRUE(std::regex_search(
        name, std::regex("^(libc|libm|libstdc\\+\\+|libgcc_s|ld-linux|libfmt|libtomlplusplus|libasan|libubsan)")))
        << name;
  }
  std::printf("[figure] needed_libraries = %d (limit <= 8)\n", libraries);
  EXPECT_GT(libraries, 0);
  EXPECT_LE(libraries, 8);
}

}  // namespace
}  // namespace fastsplat::test
