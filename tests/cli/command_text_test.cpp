// SPDX-License-Identifier: Apache-2.0
// The command that a result carries reproduces it in a shell.
#include "cli/command_text.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/shell_word.hpp"

namespace fastsplat::cli {
namespace {

std::string text(const std::vector<std::string>& words) { return command_text(words); }

TEST(Again, OmitsFlagsThatDoNotChangeTheResult) {
  EXPECT_EQ(text({"compare", "a.exr", "b.exr", "--json", "c.json", "--min-psnr", "48", "--quiet"}),
            "fastsplat compare a.exr b.exr --min-psnr 48");
  EXPECT_EQ(text({"cycles", "--json=-", "--threads=2", "--volume", "shells:8", "--threads", "1"}),
            "fastsplat cycles --volume shells:8");
}

TEST(Again, QuotesAsAShellReadsIt) {
  EXPECT_EQ(text({"errors", "propose", "--target", "psnr>=50", "--set", "a=b c"}),
            "fastsplat errors propose --target 'psnr>=50' --set 'a=b c'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace fastsplat::cli
