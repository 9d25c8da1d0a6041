// The family's table as text, and docs/family.md.
#pragma once

#include <string>
#include <vector>

#include "analysis/family/family_table.hpp"

namespace fastsplat::analysis {

/// A Markdown table, a row a cell; nanoseconds where they were taken. Remarks are letters, explained below it.
std::string family_text(const std::vector<FamilyCell>& cells);
/// docs/family.md: all that is the same on every machine.
std::string family_page();

}  // namespace fastsplat::analysis
