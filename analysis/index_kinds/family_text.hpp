// SPDX-License-Identifier: Apache-2.0
// The table of index kinds as text.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

/// A Markdown table with one row per cell; nanoseconds if measured. Remarks are letters, explained below it.
std::string family_text(const std::vector<FamilyCell>& cells);
/// "max | rms | bias".
std::string error_cells(const FieldError& error);

}  // namespace fastsplat::analysis
