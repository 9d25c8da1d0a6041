// SPDX-License-Identifier: Apache-2.0
// The line that replays a failure, as a shell parses it.
#include "cli/replay_line.hpp"

#include <gtest/gtest.h>

namespace fastsplat::cli {
namespace {

TEST(ReplayLine, NamesWhatDecidesTheRun) {
  testbench::VerifyOptions options;
  options.seed = 5;
  EXPECT_EQ(replay_line("a.fss", {.config = "tiny", .changes = {}}, options),
            "fastsplat verify --stream a.fss --config tiny --ready always --input always --fill random --seed 5");
  options.reset_after = 7;
  options.fill = testbench::ResetFill::One;
  EXPECT_EQ(replay_line("a.fss", {.config = "tiny", .changes = {}}, options),
            "fastsplat verify --stream a.fss --config tiny --ready always --input always --fill one --seed 5 "
            "--reset-after 7");
}

TEST(ReplayLine, PrintsTheChangesAndBaseByDefault) {
  EXPECT_EQ(replay_line("a.fss", {.config = {}, .changes = {"radial.entries=256", "rlut.sets=8"}}, {}),
            "fastsplat verify --stream a.fss --config base --set radial.entries=256 --set rlut.sets=8 --ready always "
            "--input always --fill random --seed 1");
}

TEST(ReplayLine, QuotesForTheShell) {
  EXPECT_NE(replay_line("it's a.fss", {.config = "tiny", .changes = {}}, {}).find("--stream 'it'\\''s a.fss' --config"),
            std::string::npos);
}

}  // namespace
}  // namespace fastsplat::cli
