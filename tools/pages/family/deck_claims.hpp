// What the first lecture deck says of the FastSplats, each sentence beside the figures that speak for or against it.
#pragma once

#include <string>
#include <vector>

#include "analysis/index_kinds/ellipses.hpp"
#include "analysis/index_kinds/family_table.hpp"

namespace fastsplat::analysis {

enum class Verdict { Holds, InPart, Fails };

struct Claim {
  int slide = 0;
  std::string sentence;  ///< as the slide has it
  std::string figures;
  Verdict verdict = Verdict::Fails;  ///< decided by the figures
};

/// `cells`: all kinds over the grids at r = 4 and r = 8 with N = 1024, and at r = 4 with all lengths.
std::vector<Claim> deck_claims(const std::vector<FamilyCell>& cells, const EllipseErrors& ellipses);
/// The page's section.
std::string claims_section(const std::vector<Claim>& claims);

const char* to_string(Verdict verdict);

}  // namespace fastsplat::analysis
