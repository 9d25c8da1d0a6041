// Every command that README.md, docs/guide.md, docs/errors.md and docs/plan.md show in a ```console block runs and
// succeeds, in the order shown, in one folder per document. A trailing "# exit N" says that the command is meant to end
// with N.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

struct Shown {
  std::string command;
  int line;
  int code = 0;
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
    }
  }
  return shown;
}

// Stands in for ./run: `fastsplat` goes to this build's program; a verb that would build or test again must be one that
// the real one knows.
std::string stand_in() {
  return "#!/bin/sh\n"
         "verb=$1\n"
         "[ \"$verb\" = fastsplat ] && { shift; exec '" +
         program() +
         "' \"$@\"; }\n"
         "'" FASTSPLAT_SOURCE_DIR
         "/run' help | grep -q \"^\\./run $verb\" || { echo \"./run knows no $verb\" >&2; exit 1; }\n";
}

class Documents : public ::testing::TestWithParam<const char*> {};

TEST_P(Documents, ShowCommandsThatRun) {
  const auto shown = commands_in(read_bytes(std::filesystem::path(FASTSPLAT_SOURCE_DIR) / GetParam()));
  const TempFolder folder;
  folder.write("run", stand_in());
  std::filesystem::permissions(folder / "run", std::filesystem::perms::owner_all);
  const bool scans =
      fastsplat({"volume", "info", "ch2bet"}).code == 0 && fastsplat({"volume", "info", "ch2"}).code == 0;
  int ran = 0, skipped = 0;
  for (const auto& [command, line, code] : shown) {
    SCOPED_TRACE(std::string(GetParam()) + ":" + std::to_string(line) + ": " + command);
    if (command.starts_with("git ") || command.starts_with("cd ") || command.starts_with("sudo ") ||
        command.starts_with("apt"))
      continue;
    if (!scans && command.find("ch2") != std::string::npos) {
      ++skipped;
      continue;
    }
    Surroundings here;
    here.folder = folder.path();
    here.environment = {"PATH=" + std::filesystem::path(program()).parent_path().string() + ":" + std::getenv("PATH")};
    const auto result = run_words({"sh", "-c", command}, here);
    EXPECT_FALSE(result.timed_out);
    EXPECT_EQ(result.code, code) << result.out << result.err;
    ++ran;
  }
  std::printf("[figure] %s commands = %d (limit > 0)%s\n", GetParam(), ran,
              skipped > 0 ? ", those on mricron-data's scans skipped: package not installed" : "");
  ASSERT_GT(ran, 0) << "nothing was checked";
}

INSTANTIATE_TEST_SUITE_P(Cli, Documents,
                         ::testing::Values("README.md", "docs/guide.md", "docs/errors.md", "docs/plan.md"));

TEST(DocumentsMustFail, FindTheCommands) {
  const auto shown = commands_in("x\n```console\n$ a b \\\n  c\noutput\n$ d  # exit 3\n```\n$ e\n```sh\n$ f\n```\n");
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].command, "a b   c");
  EXPECT_EQ(shown[1].code, 3);
  EXPECT_EQ(shown[1].line, 6);
}

}  // namespace
}  // namespace fastsplat::cli_test
