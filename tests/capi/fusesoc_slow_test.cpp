// SPDX-License-Identifier: Apache-2.0
// fastsplat.core names every module of rtl/, only files that exist, and only keys that FuseSoC knows. Its generator
// makes the package, and Verilator reads the files in the core's order.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/capi/recorded_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

TEST(CapiFusesoc, TheCoreNamesExistingFiles) {
  const std::string python = python_with("yaml");
  if (python.empty()) GTEST_SKIP() << "python3-yaml is not installed";
  const cli_test::TempFolder folder;
  const auto result = cli_test::run_words({python, FASTSPLAT_SOURCE_DIR "/tests/capi/fusesoc_core.py",
                                           FASTSPLAT_SOURCE_DIR, FASTSPLAT_BINARY_DIR, folder.path().string()});
  std::printf("%s", result.out.c_str());
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("[figure] core_files ="), std::string::npos);
}

}  // namespace
}  // namespace fastsplat::test
