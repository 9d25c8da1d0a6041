// SPDX-License-Identifier: Apache-2.0
// The flags that choose rows and columns of merged results.
#pragma once

#include "analysis/sweep/columns.hpp"
#include "cli/options.hpp"

namespace fastsplat::cli {

struct RowFlags {
  std::string merged;  ///< file written by `plan merge`
  std::string columns;
  std::vector<std::string> where, sort;
  int most = 0;
  plan::TableOptions options() const;
};

void declare(Options& options, RowFlags& to);

}  // namespace fastsplat::cli
