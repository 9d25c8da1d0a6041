// No device of a product holds a fault: the macro that puts them in is named for the one device that is made to be
// broken, a simulation of its own.
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

/// Generated C++ of a Verilated library that names a fault.
int files_with_faults(const char* library, int& files) {
  int found = 0;
  for (const auto& path : files_below(kBinary / "verilated" / library / "obj", {".cpp", ".h"})) {
    ++files;
    if (read(path).find("fault_pkg") != std::string::npos) ++found;
  }
  return found;
}

TEST(Release, TheVerilatedDeviceHoldsNoFault) {
  int files = 0, faulty_files = 0;
  EXPECT_EQ(files_with_faults("rtl_tiny", files), 0);
  EXPECT_GT(files, 5);
  for (const char* library : {"rtl_faulty", "rtl_faulty_samples", "rtl_faulty_cull", "rtl_faulty_post"})
    EXPECT_GT(files_with_faults(library, faulty_files), 0) << "the search would find nothing anywhere";
  std::printf("[figure] generated files of the device searched = %d (limit > 5)\n", files);
}

TEST(Release, NothingButTheMustFailBuildNamesTheMacro) {
  int files = 0;
  for (const char* folder :
       {"base", "cmodel", "driver", "testbench", "analysis", "cli", "cmake", "rtl", "packaging", "bench"}) {
    for (const auto& path : files_below(kSource / folder, {".cpp", ".hpp", ".txt", ".cmake", ".sh", ".sv", ".svh"})) {
      ++files;
      if (path.filename() == "fault.svh" || path == kSource / "testbench/faults/CMakeLists.txt") continue;
      EXPECT_EQ(read(path).find("FASTSPLAT_FAULT_SELECT"), std::string::npos) << path;
    }
  }
  for (const char* file : {"CMakeLists.txt", "CMakePresets.json", "run", "tests/CMakeLists.txt"}) {
    ++files;
    EXPECT_EQ(read(kSource / file).find("FASTSPLAT_FAULT_SELECT"), std::string::npos) << file;
  }
  EXPECT_NE(read(kSource / "testbench/faults/CMakeLists.txt").find("FASTSPLAT_FAULT_SELECT"), std::string::npos);
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
