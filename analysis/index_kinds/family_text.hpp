// The family's table as text.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

/// A Markdown table, a row a cell; nanoseconds where they were taken. Remarks are letters, explained below it.
std::string family_text(const std::vector<FamilyCell>& cells);
/// "max | rms | bias".
std::string error_cells(const FieldError& error);

}  // namespace fastsplat::analysis
