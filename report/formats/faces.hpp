// Results in the formats of others: JUnit XML for build servers, CSV for spreadsheets, Markdown for a review.
#pragma once

#include <string>
#include <vector>

#include "report/results.hpp"

namespace fastsplat::report {

/// A test suite per result and a test case per gate; one that failed says why and how to see it again.
std::string to_junit(const std::vector<Result>& results);

/// RFC 4180: a header and the rows of all results, numbers as they are in the JSON. Of several results, the first
/// column says which one a row is of, and a column that a result does not have is empty in its rows.
std::string to_csv(const std::vector<Result>& results);

/// Per result a heading with its verdict, its gates where it has limits, and its rows as a table; a long one is cut,
/// and says so.
std::string to_markdown(const std::vector<Result>& results);

}  // namespace fastsplat::report
