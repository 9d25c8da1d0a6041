// SPDX-License-Identifier: Apache-2.0
// Output formats for other tools: JUnit XML for build servers, CSV for spreadsheets, Markdown for reviews. Like the
// page they name files without their folders (report/file_names.hpp).
#pragma once

#include <string>
#include <vector>

#include "report/results.hpp"

namespace fastsplat::report {

/// A test suite per result and a test case per gate; failures give the reason and the command that reproduces them.
std::string to_junit(const std::vector<Result>& results);

/// RFC 4180: a header and the rows of all results, numbers as in the JSON. With several results, the first column names
/// the result of each row; columns that a result does not have are empty in its rows.
std::string to_csv(const std::vector<Result>& results);

/// Per result a heading with its verdict, its gates if it has limits, and its rows as a table; says if the table is
/// cut.
std::string to_markdown(const std::vector<Result>& results);

}  // namespace fastsplat::report
