// SPDX-License-Identifier: Apache-2.0
// Merged results as a table: its columns, rows, order and formats.
#pragma once

#include <string>
#include <vector>

#include "analysis/sweep/merged.hpp"

namespace fastsplat::plan {

struct TableOptions {
  /// Names of axes, metrics, or id, kind, status, message, config_hash, scene_hash, program_hash, command. Empty: the
  /// axes with several values, the status unless all pass, the metrics that differ between rows, config_hash.
  std::vector<std::string> columns{};
  std::vector<std::string> where{};  ///< "NAME=VALUE": rows whose column NAME reads VALUE
  std::vector<std::string> sort{};   ///< columns, the most significant first; "-NAME": descending
  std::size_t most = 0;              ///< most rows; 0: all
};

/// Whether every table has a column of this name beside those of the axes and metrics.
bool is_fixed_column(const std::string& name);
/// Where the fixed column `name` is found: an axis of that name takes it, and the fixed column is then "case.NAME".
std::string fixed_column(const Merged& merged, const std::string& name);

/// A cell: its full text, and its number if it is one.
struct Cell {
  std::string text;
  std::optional<double> number{};
};

struct Table {
  std::vector<std::string> columns, titles;  ///< titles with units
  std::vector<std::vector<Cell>> rows;
  std::size_t left_out = 0;  ///< rows beyond `most`
};

/// Throws UserError (Usage) for unknown columns.
Table table_of(const Merged& merged, const TableOptions& options);

/// Throws as table_of does.
Cell cell_of(const Merged& merged, const Row& row, const std::string& column);
/// Rows selected by `where`, in the order of `sort`.
std::vector<const Row*> chosen_rows(const Merged& merged, const TableOptions& options);

/// Aligned columns; numbers have six digits.
std::string to_text(const Table& table);
std::string to_markdown(const Table& table);
/// RFC 4180, numbers in full; the first line names the columns.
std::string to_csv(const Table& table);

}  // namespace fastsplat::plan
