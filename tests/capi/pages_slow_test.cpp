// SPDX-License-Identifier: Apache-2.0
// The command lines that the pages show for Verilator name existing files, and Verilator reads them. Run with
// --lint-only, which takes the same options and files.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::test {
namespace {

/// The indented command of a page that begins with `begin`, its lines joined.
std::string command_of(const std::string& page, const std::string& begin) {
  std::istringstream lines(cli_test::read_bytes(std::string(FASTSPLAT_SOURCE_DIR) + "/docs/" + page));
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    if (out.empty() && !line.starts_with("    " + begin)) continue;
    out += line;
    if (!out.ends_with("\\")) return out;
    out.pop_back();
  }
  return {};
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what << " is not in: " << text;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

class Pages : public ::testing::Test {
 protected:
  /// Run in the sources' folder, with the package elsewhere.
  void read_by_verilator(const std::string& page, const std::string& mode) {
    std::string command = command_of(page, "verilator ");
    ASSERT_NE(command, "") << page;
    command = replaced(command, mode, "--lint-only --quiet-exit");
    command = replaced(command, "fastsplat_pkg.sv", package_);
    const auto made = cli_test::run_words(
        {"/bin/sh", "-c",
         "cd " FASTSPLAT_SOURCE_DIR " && " FASTSPLAT_EMIT_PACKAGE " tiny >" + package_ + " && " + command});
    std::printf("[figure] %s: exit code %d (limit 0) of%s\n", page.c_str(), made.code, command.c_str());
    EXPECT_EQ(made.code, 0) << made.out << made.err;
  }

  cli_test::TempFolder folder_;
  std::string package_ = folder_ / "fastsplat_pkg.sv";
};

// M-port-1
TEST_F(Pages, MicroarchitecturesLineIsRead) { read_by_verilator("microarchitecture.md", "--cc"); }
TEST_F(Pages, CapisLineIsRead) { read_by_verilator("capi.md", "--binary"); }

}  // namespace
}  // namespace fastsplat::test
