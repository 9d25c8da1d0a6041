// SPDX-License-Identifier: Apache-2.0
// The head by kinds of index: one or two cells, against the page.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "analysis/index_kinds/head.hpp"
#include "tests/paths.hpp"
#include "tools/pages/family/family_page.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind;

TEST(FamilyHead, ACellEqualsThePage) {
  const auto head = head_scene();
  if (!head.is_scan) GTEST_SKIP() << "the scan is not installed";
  std::ostringstream page;
  page << std::ifstream(FASTSPLAT_SOURCE_DIR "/docs/family.md").rdbuf();
  const auto cells = head_table(head, {.kinds = {IndexKind::Rlut}, .grids = {16}, .entries = {256}}, 0, {});
  ASSERT_EQ(cells.size(), 1U);
  const std::string row = head_row(cells[0]);
  std::printf("[figure] row = %s", row.c_str());
  EXPECT_GT(cells[0].error.rms, 0.0);
  EXPECT_NE(page.str().find(row), std::string::npos) << "tools/family makes it again";
}

}  // namespace
}  // namespace fastsplat::analysis
