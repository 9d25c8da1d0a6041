// SPDX-License-Identifier: Apache-2.0
// A plain-text table: columns as wide as needed, numbers right-aligned.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::cli {

struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each with a cell per column
};

/// A line for the header and one per row. A column whose cells are all numbers or "-" is right-aligned.
std::string to_text(const TextTable& table);

}  // namespace fastsplat::cli
