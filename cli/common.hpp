// SPDX-License-Identifier: Apache-2.0
// The flags that every subcommand has.
#pragma once

#include <string>

#include "cli/options.hpp"

namespace fastsplat::cli {

struct Common {
  std::string json;    ///< --json: a file, `-` for stdout, empty for none
  bool quiet = false;  ///< --quiet: errors only
  int threads = 0;     ///< --threads: 0 all cores; never changes a result
};

void declare(Options& options, Common& to);

}  // namespace fastsplat::cli
