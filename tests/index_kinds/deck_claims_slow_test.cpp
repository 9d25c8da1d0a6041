// SPDX-License-Identifier: Apache-2.0
// The deck's sentences: each has a verdict, by its figures.
#include <gtest/gtest.h>

#include <cstdio>

#include "tools/pages/family/deck_claims.hpp"
#include "tools/pages/family/family_page.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

const Claim& claim_of(const std::vector<Claim>& claims, const std::string& words) {
  for (const Claim& claim : claims) {
    if (claim.sentence.find(words) != std::string::npos) return claim;
  }
  throw std::runtime_error("no sentence with " + words);
}

TEST(DeckClaims, VerdictsFollowTheFigures) {
  auto cells = page_cells();
  const auto flat = spread_ellipses(16.0);
  const auto before = deck_claims(cells, flat);
  int held = 0;
  for (const Claim& claim : before) held += claim.verdict == Verdict::Holds ? 1 : 0;
  std::printf("[figure] sentences = %zu, hold = %d\n", before.size(), held);
  EXPECT_EQ(before.size(), 10U);
  EXPECT_EQ(claim_of(before, "2D FastSplat").verdict, Verdict::InPart) << "accurate and compact at once?";

  // The same cells with a coarse rlut with many entries, and ellipses with one add more.
  for (FamilyCell& cell : cells) {
    if (cell.config.index() == IndexKind::Rlut) cell.bits *= 1000;
    if (cell.config.index() == IndexKind::SquaredElliptic) ++cell.operations.adds;
    if (cell.config.index() == IndexKind::Blit2d) cell.operations.multiplies = 0;
    if (cell.config.index() == IndexKind::Linear) cell.cycles = 1, cell.aligned.largest = 9.0;
  }
  const auto after = deck_claims(cells, flat);
  int turned = 0;
  for (const char* words : {"1D RLUT", "For elliptical kernels", "No run-time", "1D Linear"}) {
    EXPECT_EQ(claim_of(before, words).verdict, Verdict::Holds) << words;
    EXPECT_NE(claim_of(after, words).verdict, Verdict::Holds) << words;
    EXPECT_NE(claim_of(after, words).figures, claim_of(before, words).figures) << words;
    ++turned;
  }
  std::printf("[figure] verdicts turned = %d\n", turned);
}

}  // namespace
}  // namespace fastsplat::analysis
