// docs/family.md.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

/// What docs/family.md and its pictures are made of: all kinds over grids and radii with N = 1024, and at r = 4 with
/// all lengths of the table.
std::vector<FamilyCell> page_cells();
/// docs/family.md: all that is the same on every machine. `head` is head_section(), which takes minutes.
std::string family_page(const std::vector<FamilyCell>& cells, const std::string& head);

}  // namespace fastsplat::analysis
