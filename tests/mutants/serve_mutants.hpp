// SPDX-License-Identifier: Apache-2.0
// check_mutants programs: `PROGRAM CONFIG.toml` reads numbers of mutants from standard input, one a line, and prints a
// line for each:
//
//     NUMBER killed CHECK: MESSAGE   or   NUMBER lives COMPARISONS SECONDS
//
// The checks run cheapest first; the first that fails ends the mutant. Each mutant has a separate process and a limit
// of processor time. Number 0 is the unchanged source: it has to live, and its time sets the limit.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace fastsplat::test {

/// What a check said; empty: nothing is wrong.
struct Said {
  std::string text;
  std::uint64_t comparisons = 0;
};
struct Named {
  std::string name;
  std::function<Said()> check;
};

/// The program, until standard input ends, with the checks of a configuration's path. Exit code: 1 where number 0 does
/// not live, 2 usage, 3 an error.
int mutants_main(int argc, char** argv, const std::function<std::vector<Named>(const char*)>& checks_of);

}  // namespace fastsplat::test
