// SPDX-License-Identifier: Apache-2.0
// Exit codes in words, for help and man pages (docs/guide/reference.md, "Exit codes").
#pragma once

#include <array>

#include "base/error.hpp"

namespace fastsplat::cli {

struct ExitMeaning {
  ExitCode code;
  const char* word;
  const char* meaning;
};

inline constexpr std::array kExitMeanings{
    ExitMeaning{ExitCode::Pass, "pass", "done; verification passed"},
    ExitMeaning{ExitCode::Failed, "failed", "a limit or verification failed; two configurations differ"},
    ExitMeaning{ExitCode::Usage, "usage", "the command line is invalid"},
    ExitMeaning{ExitCode::Input, "input or output", "a file is missing or invalid, or a result cannot be written"},
    ExitMeaning{ExitCode::NotComparable, "not comparable", "the two inputs cannot be compared"},
    ExitMeaning{ExitCode::Simulation, "simulation",
                "the simulated device hung, refused the stream or failed an assertion"},
    ExitMeaning{ExitCode::Internal, "internal", "an internal error: please report it"},
    ExitMeaning{ExitCode::Interrupted, "interrupted", "ended by Ctrl-C (128 + signal for others)"},
};

}  // namespace fastsplat::cli
