// SPDX-License-Identifier: Apache-2.0
// The list of faults that mutants.sh plants: the text that each one changes still exists.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/driver/scenes_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::driver {
namespace {

std::string read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(FASTSPLAT_SOURCE_DIR "/" + path).rdbuf();
  return text.str();
}

TEST(DriverMutants, EachFindsItsTextOnce) {
  std::istringstream list(read("tests/driver/mutants.txt"));
  int faults = 0;
  for (std::string line; std::getline(list, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto file = line.find(" @ ") + 3, old = line.find(" @ ", file) + 3, end = line.find(" @", old);
    ASSERT_TRUE(file > 2 && old > 2 && end != std::string::npos) << line;
    ++faults;
    const std::string text = read(line.substr(file, old - 3 - file)), wanted = line.substr(old, end - old);
    const auto at = text.find(wanted);
    EXPECT_NE(at, std::string::npos) << line;
    if (at == std::string::npos) continue;
    EXPECT_EQ(text.find(wanted, at + 1), std::string::npos) << "twice: " << line;
  }
  figure("faults listed", faults);
  EXPECT_GT(faults, 0);
}

}  // namespace
}  // namespace fastsplat::driver
