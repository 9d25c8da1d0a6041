// SPDX-License-Identifier: Apache-2.0
// Products contain no faults: the macro that enables them is named only for the device that is made to be broken, a
// simulation of its own.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = FASTSPLAT_SOURCE_DIR;
const fs::path kBinary = FASTSPLAT_BINARY_DIR;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && extensions.contains(entry.path().extension())) files.push_back(entry.path());
  return files;
}

std::set<std::string> matches(const std::string& text, const char* pattern) {
  std::set<std::string> names;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

TEST(Release, TheSimulatorsHoldNoFault) {
  int healthy = 0, faulty = 0;
  for (const auto& path : files_below(kBinary / "lib/fastsplat", {".so"})) {
    const bool has_faults = read(path).find("fault_pkg") != std::string::npos;
    const bool meant = path.filename().string().find("-faults") != std::string::npos;
    EXPECT_EQ(has_faults, meant) << path;
    ++(meant ? faulty : healthy);
  }
  std::printf("[figure] modules of RTL searched = %d (limit > 2), with faults on purpose = %d (limit > 2)\n", healthy,
              faulty);
  EXPECT_GT(healthy, 2);
  EXPECT_GT(faulty, 2);
}

TEST(Release, NothingButTheMustFailBuildNamesTheMacro) {
  int files = 0;
  for (const char* folder : {"base", "cmodel", "driver", "testbench", "analysis", "cli", "rtl", "tools"}) {
    for (const auto& path : files_below(kSource / folder, {".cpp", ".hpp", ".txt", ".cmake", ".sh", ".sv", ".svh"})) {
      ++files;
      if (path.filename() == "fault.svh" || path == kSource / "testbench/module/build.sh" ||
          path == kSource / "testbench/capi/example/fastsplat_bench.sv")
        continue;
      EXPECT_EQ(read(path).find("FASTSPLAT_FAULT_SELECT"), std::string::npos) << path;
    }
  }
  for (const char* file : {"CMakeLists.txt", "CMakePresets.json", "run", "tests/CMakeLists.txt"}) {
    ++files;
    EXPECT_EQ(read(kSource / file).find("FASTSPLAT_FAULT_SELECT"), std::string::npos) << file;
  }
  EXPECT_NE(read(kSource / "testbench/module/build.sh").find("FASTSPLAT_FAULT_SELECT"), std::string::npos);
  std::printf("[figure] files searched = %d (limit > 50)\n", files);
  EXPECT_GT(files, 50);
}

TEST(Faults, TableAndRtlNameTheSame) {
  std::set<std::string> placed;
  for (const auto& path : files_below(kSource / "rtl", {".sv", ".svh"}))
    placed.merge(matches(read(path), "`FASTSPLAT_FAULT\\((\\w+)\\)"));
  std::set<std::string> listed;
  for (const char* table : {"testbench/faults/faults.def", "tests/fetch/fetch_faults.def"})
    listed.merge(matches(read(kSource / table), "\nFAULT\\((\\w+),"));
  EXPECT_EQ(placed, listed);
  std::printf("[figure] faults = %zu (limit >= 12)\n", listed.size());
  EXPECT_GE(listed.size(), 12U);
}

}  // namespace
}  // namespace fastsplat::test
