// SPDX-License-Identifier: Apache-2.0
#include "cli/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/number_text.hpp"
#include "base/printable.hpp"

namespace fastsplat::cli {

std::string to_text(const TextTable& raw) {
  TextTable table = raw;
  for (auto& row : table.rows) std::ranges::transform(row, row.begin(), printable);
  const std::size_t columns = table.columns.size();
  std::vector<std::size_t> widths(columns);
  std::vector<char> right(columns, 1);
  for (std::size_t column = 0; column < columns; ++column) {
    widths[column] = table.columns[column].size();
    for (const auto& row : table.rows) {
      widths[column] = std::max(widths[column], row[column].size());
      if (row[column] != "-" && !number_from(row[column])) right[column] = 0;
    }
  }
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t column = 0; column < columns; ++column) {
      line += column == 0 ? "" : "  ";
      line += right[column] != 0 ? fmt::format("{:>{}}", cells[column], widths[column])
                                 : fmt::format("{:<{}}", cells[column], widths[column]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return text;
}

}  // namespace fastsplat::cli
