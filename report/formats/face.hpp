// A result as build servers, spreadsheets and reviewers take it: gates that held or did not, and rows.
#pragma once

#include <string>
#include <vector>

#include "report/figures.hpp"

namespace fastsplat::report {

/// Something that may fail, and did or did not.
struct Gate {
  std::string name;
  Status status = Status::Pass;
  std::string message;  ///< one line or more; of those that hold, too
  std::string command;  ///< that shows it again; empty where the result does not tell
};

/// Of a verb's result, the gates in its order; of one that only measures, that it was done. UserError (Input) where a
/// figure is missing or none that can be.
std::vector<Gate> gates_of(const Result& result);

/// What a result lists: each row has a value, maybe null, for each column.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Json>> rows;
};

/// The list that matters of a verb's result: a plan's rows, the steps of `errors`, the losses of `cycles`, the cells of
/// `family`. Objects in a row become columns, "config.name"; lists stay JSON. UserError (Input) as above.
Table table_of(const Result& result);

}  // namespace fastsplat::report
