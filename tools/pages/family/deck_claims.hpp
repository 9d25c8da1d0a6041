// SPDX-License-Identifier: Apache-2.0
// Claims of the first lecture deck about FastSplats, each with the figures that support or refute it.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/ellipses.hpp"
#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

enum class Verdict { Holds, InPart, Fails };

struct Claim {
  int slide = 0;
  std::string sentence;  ///< as on the slide
  std::string figures;
  Verdict verdict = Verdict::Fails;  ///< decided by the figures
};

/// `cells`: all kinds over the grids at r = 4 and r = 8 with N = 1024, and at r = 4 with all table lengths.
std::vector<Claim> deck_claims(const std::vector<FamilyCell>& cells, const EllipseErrors& ellipses);
/// The section of docs/family.md.
std::string claims_section(const std::vector<Claim>& claims);

const char* to_string(Verdict verdict);

}  // namespace fastsplat::analysis
