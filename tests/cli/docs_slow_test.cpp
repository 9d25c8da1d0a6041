// SPDX-License-Identifier: Apache-2.0
// Every command that README.md and a page of docs/ show in a ```console block runs, in the order shown, in one folder
// per page. A trailing "# exit N" gives its exit code. Lines shown below a command are its whole output, in its order;
// "..." stands for any text, alone on a line for any lines. Pages leave out the notes of the time taken and of a
// simulator's first build, and may leave out all of a command's output.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;

struct Shown {
  std::string command;
  int line;
  int code = 0;
  std::vector<std::string> output{};
};

std::vector<Shown> commands_in(const std::string& text) {
  static const std::regex exits(R"(#\s*exit\s+(\d+)\s*$)");
  std::vector<Shown> shown;
  std::istringstream lines(text);
  std::string line;
  bool inside = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.starts_with("```")) {
      inside = line == "```console";
    } else if (inside && line.starts_with("$ ")) {
      Shown command{line.substr(2), number};
      std::smatch match;
      if (std::regex_search(command.command, match, exits)) command.code = std::stoi(match[1]);
      shown.push_back(command);
    } else if (inside && !shown.empty() && shown.back().command.ends_with("\\")) {
      shown.back().command.pop_back();
      shown.back().command += line;
    } else if (inside && !shown.empty()) {
      shown.back().output.push_back(line);
    }
  }
  return shown;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Whether `line` is `shown`, in which "..." stands for any text.
bool matches(const std::string& line, std::string_view shown) {
  std::size_t at = 0;
  for (bool first = true;; first = false) {
    const auto gap = shown.find("...");
    const std::string_view part = shown.substr(0, gap);
    const auto found = gap == shown.npos && !first ? line.rfind(part) : line.find(part, at);
    if (found == line.npos || found < at || (first && found != 0)) return false;
    at = found + part.size();
    if (gap == shown.npos) return at == line.size();
    shown.remove_prefix(gap + 3);
  }
}

/// Whether `printed`, from line `at` on, is what `shown` shows from its line `from` on.
bool shows(const std::vector<std::string>& shown, const std::vector<std::string>& printed, std::size_t from = 0,
           std::size_t at = 0) {
  for (; from < shown.size(); ++from, ++at) {
    if (shown[from] == "...") {
      for (std::size_t next = at; next <= printed.size(); ++next) {
        if (shows(shown, printed, from + 1, next)) return true;
      }
      return false;
    }
    if (at == printed.size() || !matches(printed[at], shown[from])) return false;
  }
  return at == printed.size();
}

// Replaces ./run: `fastsplat` is this build's program; commands that would build or test again only have to exist in
// the real one.
std::string stand_in() {
  return "#!/bin/sh\n"
         "verb=$1\n"
         "[ \"$verb\" = fastsplat ] && { shift; exec '" +
         program() +
         "' \"$@\"; }\n"
         "'" FASTSPLAT_SOURCE_DIR
         "/run' help | grep -q \"^\\./run $verb\" || { echo \"./run knows no $verb\" >&2; exit 1; }\n";
}

/// Pages that must show commands, and all others that do.
std::set<std::string> pages() {
  std::set<std::string> all{"README.md", "docs/verify-rtl.md", "docs/size-a-device.md", "docs/compare-pictures.md",
                            "docs/guide/tutorial.md"};
  const fs::path root = FASTSPLAT_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    const std::string page = fs::relative(entry.path(), root).string();
    // The commands of integration.md are of another program: tests/examples/system.sh runs them.
    if (page.ends_with(".md") && page != "docs/integration.md" && !commands_in(read_bytes(entry.path())).empty())
      all.insert(page);
  }
  return all;
}

/// Without the scans of mricron-data, hence without the output shown.
std::string with_built_in_scan(const std::string& command) {
  return std::regex_replace(command, std::regex(R"(\bch2(bet)?\b)"), "shells:48");
}

class Documents : public ::testing::TestWithParam<std::string> {};

TEST_P(Documents, ShowCommandsThatRun) {
  const auto shown = commands_in(read_bytes(fs::path(FASTSPLAT_SOURCE_DIR) / GetParam()));
  const TempFolder folder;
  folder.write("run", stand_in());
  fs::permissions(folder / "run", fs::perms::owner_all);
  const bool scans =
      fastsplat({"volume", "info", "ch2bet"}).code == 0 && fastsplat({"volume", "info", "ch2"}).code == 0;
  const bool page_of_scans = !scans && std::any_of(shown.begin(), shown.end(), [](const Shown& one) {
    return one.command != with_built_in_scan(one.command);
  });
  int ran = 0, compared = 0;
  for (const auto& [command, line, code, output] : shown) {
    SCOPED_TRACE(GetParam() + ":" + std::to_string(line) + ": " + command);
    if (command.starts_with("git ") || command.starts_with("cd ") || command.starts_with("sudo ") ||
        command.starts_with("apt"))
      continue;
    Surroundings here;
    here.folder = folder.path();
    here.environment = {"PATH=" + fs::path(program()).parent_path().string() + ":" + std::getenv("PATH")};
    const std::string words = scans ? command : with_built_in_scan(command);
    const auto result = run_words({"sh", "-c", "{ " + words + "\n} 2>&1"}, here);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.code, code) << result.out;
    ++ran;
    if (page_of_scans) continue;
    if (output.empty()) continue;
    auto printed = lines_of(result.out);
    static const std::regex note(R"(fastsplat: (.* in \d+\.\d s|building the simulator .*))");
    std::erase_if(printed, [](const std::string& text) { return std::regex_match(text, note); });
    EXPECT_TRUE(shows(output, printed)) << "the page shows other lines than the command printed:\n" << result.out;
    compared += static_cast<int>(output.size());
  }
  std::printf("[figure] %s: commands = %d (limit > 0), lines of output = %d%s\n", GetParam().c_str(), ran, compared,
              page_of_scans ? "; shells:48 instead of mricron-data's scans: package not installed" : "");
  ASSERT_GT(ran, 0) << "nothing was checked";
}

INSTANTIATE_TEST_SUITE_P(Cli, Documents, ::testing::ValuesIn(pages()), [](const auto& page) {
  return std::regex_replace(page.param, std::regex("[^A-Za-z0-9]"), "_");
});

TEST(DocumentsMustFail, FindTheCommands) {
  const auto shown = commands_in("x\n```console\n$ a b \\\n  c\noutput\n$ d  # exit 3\n```\n$ e\n```sh\n$ f\n```\n");
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].command, "a b   c");
  EXPECT_EQ(shown[1].code, 3);
  EXPECT_EQ(shown[0].output, std::vector<std::string>{"output"});
  EXPECT_EQ(shown[1].line, 6);
}

TEST(DocumentsMustFail, SeeOutputThatDiffers) {
  EXPECT_TRUE(matches("pass: 12 splats in 3.4 s", "pass: 12 splats in ... s"));
  EXPECT_TRUE(matches("pass: 12 splats", "pass: 12 splats"));
  EXPECT_TRUE(matches("a b a b", "a ... b"));
  EXPECT_FALSE(matches("pass: 12 splats", "pass: 13 splats"));
  EXPECT_FALSE(matches("pass: 12 splats", "pass: 12"));
  EXPECT_FALSE(matches("pass: 12 splats", "12 splats"));
  EXPECT_FALSE(matches("a b c", "a ... b"));
  EXPECT_TRUE(shows({"a", "...", "c"}, {"a", "b", "b", "c"}));
  EXPECT_TRUE(shows({"a", "..."}, {"a"}));
  EXPECT_FALSE(shows({"a", "c"}, {"a", "b", "c"})) << "a line left out";
  EXPECT_FALSE(shows({"b", "a"}, {"a", "b"})) << "another order";
  EXPECT_FALSE(shows({"a"}, {"a", "b"})) << "the last line left out";
}

}  // namespace
}  // namespace fastsplat::cli_test
