// A table in plain text: columns as wide as they need, numbers to the right.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::cli {

struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each with a cell per column
};

/// A line for the header and one per row. A column whose cells are all numbers or "-" stands to the right.
std::string to_text(const TextTable& table);

}  // namespace fastsplat::cli
