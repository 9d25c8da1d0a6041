// SPDX-License-Identifier: Apache-2.0
// The pictures of docs/family.md.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

/// File names, in the order of family_plots().
inline constexpr const char* kFamilyPictures[] = {"family-bits.svg", "family-grid.svg"};

struct NamedPicture {
  std::string file;
  std::string svg;
};

/// `cells` must contain all kinds at r = 4. Plots the least error of the turned field of each kind over bits, and its
/// error over K at N = 1024.
std::vector<NamedPicture> family_plots(const std::vector<FamilyCell>& cells);

}  // namespace fastsplat::analysis
