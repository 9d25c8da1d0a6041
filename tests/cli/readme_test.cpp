// SPDX-License-Identifier: Apache-2.0
// README.md: its figures are on the pages that it names; its doors lead to every subcommand.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "base/read_file.hpp"
#include "cli/command_line.hpp"
#include "tests/paths.hpp"

namespace fastsplat::cli {
namespace {

std::string page_text(const std::string& page) { return read_text_file(FASTSPLAT_SOURCE_DIR "/" + page); }

std::vector<std::string> numbers_in(const std::string& text) {
  static const std::regex number(R"(\d([\d,.]*\d)?)");
  return {std::sregex_token_iterator(text.begin(), text.end(), number), {}};
}

/// Figures of a row "| what | figures | [page](file#place) |" that the page does not have; empty for any other line.
std::vector<std::string> figures_missing(const std::string& row, int& figures) {
  static const std::regex shape(R"(^\|[^|]*\|([^|]*)\| \[[^\]]*\]\(([^)#]+)[^)]*\) \|$)");
  std::smatch match;
  if (!std::regex_match(row, match, shape)) return {};
  const auto known = numbers_in(page_text(match[2]));
  std::vector<std::string> missing;
  for (const auto& figure : numbers_in(match[1])) {
    ++figures;
    if (std::find(known.begin(), known.end(), figure) == known.end()) missing.push_back(figure);
  }
  return missing;
}

TEST(Readme, FiguresStandInThePagesItNames) {
  std::istringstream lines(page_text("README.md"));
  int figures = 0;
  for (std::string line; std::getline(lines, line);) {
    for (const auto& figure : figures_missing(line, figures))
      ADD_FAILURE() << figure << " is not on the page: " << line;
  }
  std::printf("[figure] readme_figures = %d (limit >= 15)\n", figures);
  EXPECT_GE(figures, 15) << "nothing was checked";
}

TEST(ReadmeMustFail, SeesAFigureThatThePageDoesNotHave) {
  int figures = 0;
  EXPECT_EQ(figures_missing("| speed | 512 and 123.456 times | [peers](docs/peers.md#measured) |", figures),
            std::vector<std::string>{"123.456"});
  EXPECT_EQ(figures, 2);
}

// Every subcommand is reachable from one of the doors.
TEST(Readme, DoorsReachEverySubcommand) {
  std::string doors;
  for (const char* page : {"docs/verify-rtl.md", "docs/size-a-device.md", "docs/compare-pictures.md",
                           "docs/guide/tutorial.md", "docs/guide.md"})
    doors += page_text(page);
  int subcommands = 0;
  for (const Description& subcommand : describe()) {
    if (subcommand.name.empty() || subcommand.group) continue;
    EXPECT_NE(doors.find("fastsplat " + subcommand.name), doors.npos) << subcommand.name;
    ++subcommands;
  }
  std::printf("[figure] subcommands_reached = %d (limit > 20)\n", subcommands);
  EXPECT_GT(subcommands, 20);
}

}  // namespace
}  // namespace fastsplat::cli
