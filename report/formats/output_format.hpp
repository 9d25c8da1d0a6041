// SPDX-License-Identifier: Apache-2.0
// A result as gates and rows, for build servers, spreadsheets and reviewers.
#pragma once

#include <string>
#include <vector>

#include "report/figures.hpp"

namespace fastsplat::report {

/// A check that passed or failed.
struct Gate {
  std::string name;
  Status status = Status::Pass;
  std::string message;  ///< one or more lines, also of passed gates
  std::string command;  ///< that reproduces it; empty if not recorded
};

/// The gates of a result, in its order; a single passed gate for results without limits. UserError (Input) for missing
/// or invalid figures.
std::vector<Gate> gates_of(const Result& result);

/// A table: each row has one value per column, null if absent.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Json>> rows;
};

/// The main list of a result: a plan's rows, the steps of `errors`, the losses of `cycles`, the cells of `family`.
/// Nested objects become columns, "config.name"; lists stay JSON. UserError (Input) as above.
Table table_of(const Result& result);

}  // namespace fastsplat::report
