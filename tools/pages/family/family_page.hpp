// SPDX-License-Identifier: Apache-2.0
// Makes docs/family.md.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

/// The cells of docs/family.md and its pictures: all kinds over grids and radii with N = 1024, and at r = 4 with all
/// table lengths.
std::vector<FamilyCell> page_cells();
/// The page's text; the same on every machine. `head` is head_section(), which takes minutes.
std::string family_page(const std::vector<FamilyCell>& cells, const std::string& head);

}  // namespace fastsplat::analysis
