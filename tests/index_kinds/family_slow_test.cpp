// SPDX-License-Identifier: Apache-2.0
// The page of the family, and the content of its table.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "tests/paths.hpp"
#include "tools/pages/family/family_page.hpp"
#include "tools/pages/family/family_plots.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(FASTSPLAT_SOURCE_DIR "/docs/" + file).rdbuf();
  return text.str();
}

/// The page's section on the head, which takes minutes to make: one cell of it is in head_slow_test.cpp.
std::string head_of(const std::string& page) {
  const auto from = page.find("## The head\n");
  if (from == std::string::npos) return "";
  return page.substr(from, page.find("\n## ", from) + 1 - from);
}

TEST(FamilyPage, IsPrintedByTheProgram) {
  const std::string page = text_of("family.md"), head = head_of(page);
  EXPECT_GT(head.size(), 1000U);
  const auto cells = page_cells();
  const std::string made = family_page(cells, head);
  std::printf("[figure] characters of the page compared = %zu (limit > 5000)\n", made.size());
  EXPECT_GT(made.size(), 5000U);
  EXPECT_EQ(page, made) << "tools/family makes it again";
  const auto pictures = family_plots(cells);
  EXPECT_EQ(pictures.size(), std::size(kFamilyPictures));
  for (const auto& picture : pictures) {
    EXPECT_EQ(text_of("images/" + picture.file), picture.svg) << "tools/family makes it again";
    EXPECT_NE(page.find("(images/" + picture.file + ")"), std::string::npos) << "no link to it";
  }
}

TEST(FamilyTable, EveryFigureThatIsOffIsExplained) {
  const auto cells = family_table(whole_family());
  std::map<char, int> remarks;
  for (const FamilyCell& cell : cells) {
    for (const Remark remark : cell.remarks) {
      ++remarks[letter(remark)];
      EXPECT_NE(remark, Remark::Unexplained)
          << name_of(cell.config.index()) << ", r " << cell.radius << ", K " << cell.config.grid() << ", N "
          << cell.config.radial_entries << ": aligned " << cell.aligned.largest << " for " << cell.index_max
          << ", turned " << cell.turned.rms << " for " << cell.snap_rms;
    }
  }
  std::printf("[figure] cells = %zu\n", cells.size());
  for (const auto& [letter, count] : remarks) std::printf("[figure] remarks %c = %d\n", letter, count);
  EXPECT_EQ(cells.size(), (4 * 6 + 2) * 5U * 3U);
}

// Ellipses that are circles, the same grid and the same table: the same errors, to the last bit.
TEST(FamilyTable, CirclesAreEllipses) {
  auto range = whole_family();
  range.entries = {256};
  range.radii = {2};
  range.kinds = {IndexKind::Squared};
  const auto circles = family_table(range);
  range.kinds = {IndexKind::SquaredElliptic};
  const auto ellipses = family_table(range);
  ASSERT_EQ(circles.size(), ellipses.size());
  for (std::size_t i = 0; i < circles.size(); ++i) {
    EXPECT_EQ(circles[i].turned.rms, ellipses[i].turned.rms);
    EXPECT_EQ(circles[i].aligned.largest, ellipses[i].aligned.largest);
  }
  std::printf("[figure] cells compared = %zu\n", circles.size());
}

}  // namespace
}  // namespace fastsplat::analysis
