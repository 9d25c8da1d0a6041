// SPDX-License-Identifier: Apache-2.0
// The program in its environment: man reads its pages, real shells complete it, its examples run, and `cmake --install`
// installs all of it.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "cli/command_line.hpp"
#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

bool has(const std::string& program) { return run_words({"sh", "-c", "command -v " + program}).code == 0; }

std::string script(const TempFolder& folder, const std::string& shell) {
  const auto printed = fastsplat({"completion", shell});
  expect_success(printed);
  return folder.write("fastsplat." + shell, printed.out);
}

/// The completions that bash offers at the end of each line.
std::map<std::string, std::set<std::string>> offered(const Words& lines, const TempFolder& folder) {
  Words command{"bash", "--norc", FASTSPLAT_SOURCE_DIR "/tests/cli/completion_helper.bash", script(folder, "bash")};
  command.insert(command.end(), lines.begin(), lines.end());
  Surroundings here;
  here.folder = folder.path();
  const auto result = run_words(command, here);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  std::map<std::string, std::set<std::string>> replies;
  std::string line;
  std::istringstream text(result.out);
  for (std::string reply; std::getline(text, reply);) {
    if (reply.starts_with("> ")) {
      line = reply.substr(2);
      replies[line];
    } else {
      replies[line].insert(reply);
    }
  }
  EXPECT_EQ(replies.size(), lines.size());
  return replies;
}

TEST(Completion, BashOffersVerbsFlagsNamesAndFiles) {
  const TempFolder folder;
  folder.write("scene.toml", "");
  folder.write("shells of mine.nrrd", "");
  fs::create_directory(folder.path() / "plots");
  using Set = std::set<std::string>;
  // A line, and exactly the completions offered there.
  const std::vector<std::pair<std::string, Set>> exactly{
      {"fastsplat re", {"render", "report"}},
      {"fastsplat stream ", {"record", "dump", "replay", "vectors"}},
      {"fastsplat stream re", {"record", "replay"}},
      {"fastsplat render --si", {"--size"}},
      {"fastsplat render --perspective --si", {"--size"}},
      {"fastsplat render --method x", {"xray"}},
      {"fastsplat render --method=x", {"xray"}},
      {"fastsplat render --engine ", {"golden", "cmodel", "rtl"}},
      {"fastsplat render --volume head --size 64 --engine cmodel --config t", {"tiny"}},
      {"fastsplat render --config=s", {"small", "scene.toml", "shells of mine.nrrd"}},
      {"fastsplat render --scene sc", {"scene.toml"}},
      {"fastsplat render --scene demo:ter", {"terrain"}},  // bash keeps the part before the colon
      {"fastsplat render --index blit", {"blit2d"}},
      {"fastsplat render --set radial.en", {"radial.entries="}},
      {"fastsplat render --azimuth ", {}},
      {"fastsplat render --antialias o", {"on", "off"}},
      {"fastsplat plan run plan.json --results ", {"plots"}},  // folders only
      {"fastsplat verify --class res", {"reset"}},
      {"fastsplat verify --ready al", {"all", "always", "alternate-"}},
      {"fastsplat cycles --ready al", {"always", "alternate-"}},
      {"fastsplat config show b", {"base"}},
      {"fastsplat config show base --set array.", {"array.lanes="}},
      {"fastsplat errors prop", {"propose"}},
      {"fastsplat errors --sh", {"--shading", "--shapley"}},
      {"fastsplat errors bound --sh", {"--shading"}},
      {"fastsplat errors propose --tar", {"--target"}},
      {"fastsplat volume info mars", {"marschner-lobb"}},
      {"fastsplat volume info she", {"shells", "shells of mine.nrrd"}},
      {"fastsplat completion z", {"zsh"}},
      {"fastsplat help str", {"stream"}},
      {"fastsplat help stream d", {"dump"}},
      {"fastsplat help --man co", {"compare", "config", "completion"}},
      {"fastsplat no-such-verb --", {}},
      {"/some/where/fastsplat doctor --q", {"--quiet"}},
  };
  Words lines;
  for (const auto& [line, replies] : exactly) lines.push_back(line);
  auto replies = offered(lines, folder);
  int equal = 0;
  for (const auto& [line, expected] : exactly) {
    const Set& got = replies[line];
    EXPECT_EQ(got, expected) << line;
    equal += got == expected ? 1 : 0;
  }
  std::printf("[figure] bash_lines = %d of %zu (limit all)\n", equal, exactly.size());
}

TEST(Completion, BashOffersEveryVerbAndFlag) {
  const TempFolder folder;
  const auto all = cli::describe();
  Words lines;
  for (const auto& subcommand : all) {
    if (!subcommand.group) lines.push_back("fastsplat " + subcommand.name + " -");
  }
  auto replies = offered(lines, folder);
  int flags = 0;
  for (const auto& subcommand : all) {
    if (subcommand.group) continue;
    for (const auto& flag : subcommand.flags) {
      if (flag.positional()) continue;
      for (const auto& name : flag.names) {
        ++flags;
        EXPECT_TRUE(replies["fastsplat " + subcommand.name + " -"].contains(name)) << subcommand.name << " " << name;
      }
    }
  }
  std::printf("[figure] bash_flags = %d (limit > 300)\n", flags);
  EXPECT_GT(flags, 300);
}

class OtherShell : public ::testing::TestWithParam<const char*> {};

TEST_P(OtherShell, TakesItsScript) {
  const std::string shell = GetParam();
  if (!has(shell)) GTEST_SKIP() << shell << " is not installed; its script is only read by the fast tests";
  const TempFolder folder;
  const auto checked = run_words({shell, "-n", script(folder, shell)});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(checked.err, "");
}

INSTANTIATE_TEST_SUITE_P(Cli, OtherShell, ::testing::Values("bash", "zsh", "fish"));

TEST(Completion, FishOffersWhatItsScriptSays) {
  if (!has("fish")) GTEST_SKIP() << "fish is not installed";
  const TempFolder folder;
  const std::string file = script(folder, "fish");
  const auto offers = [&](const std::string& line) {
    Surroundings here;
    here.folder = folder.path();
    here.environment = {"HOME=" + folder.path().string(), "XDG_CONFIG_HOME=" + folder.path().string()};
    const auto result = run_words({"fish", "-c", "source " + file + "; complete -C '" + line + "'"}, here);
    EXPECT_EQ(result.err, "");
    // Fish 4 also offers words that contain the letters in this order, --slab-width for --sh; only the script's own are
    // checked.
    const std::string begun = line.substr(line.rfind(' ') + 1);
    std::set<std::string> words;
    std::istringstream lines(result.out);
    for (std::string one; std::getline(lines, one);)
      if (one.starts_with(begun)) words.insert(one.substr(0, one.find('\t')));
    return words;
  };
  EXPECT_EQ(offers("fastsplat re"), (std::set<std::string>{"render", "report"}));
  EXPECT_EQ(offers("fastsplat render --method x"), (std::set<std::string>{"xray"}));
  EXPECT_EQ(offers("fastsplat stream du"), (std::set<std::string>{"dump"}));
  EXPECT_EQ(offers("fastsplat errors bound --sh"), (std::set<std::string>{"--shading"}));
  EXPECT_EQ(offers("fastsplat verify --class res"), (std::set<std::string>{"reset"}));
}

TEST(Manual, IsReadWithoutAWarning) {
  const TempFolder folder;
  expect_success(fastsplat({"help", "--man-pages", folder.path().string()}));
  const auto pages = folder.entries();
  EXPECT_EQ(pages.size(), cli::describe().size());
  int read = 0;
  for (const Words& reader : {Words{"man", "--warnings", "-E", "UTF-8", "-l"},
                              {"groff", "-man", "-Tutf8", "-ww", "-z"},
                              {"mandoc", "-T", "lint", "-W", "error"}}) {
    if (!has(reader[0])) continue;
    for (const auto& page : pages) {
      Words command = reader;
      command.push_back(folder / page);
      Surroundings here;
      here.environment = {"MANWIDTH=80", "MAN_KEEP_FORMATTING=", "PAGER=cat", "MANPAGER=cat"};
      const auto result = run_words(command, here);
      EXPECT_EQ(result.code, 0) << reader[0] << " " << page;
      EXPECT_EQ(result.err, "") << reader[0] << " " << page;
      ++read;
    }
  }
  std::printf("[figure] pages = %zu, read %d times (limit > 20)\n", pages.size(), read);
  EXPECT_GT(pages.size(), 20u);
  if (read == 0) GTEST_SKIP() << "neither man nor groff nor mandoc is installed";
}

TEST(Manual, APageAsItIsPrinted) {
  const auto printed = fastsplat({"help", "--man", "stream", "record"});
  expect_success(printed);
  for (const char* part :
       {".TH \"FASTSPLAT\\-STREAM\\-RECORD\" 1", "\\fB\\-\\-out\\fR", "(required)", ".SS \"Camera\""})
    EXPECT_NE(printed.out.find(part), std::string::npos) << part;
  expect_error(fastsplat({"help", "--man", "redner"}), 2, {"did you mean 'render'"});
  expect_error(fastsplat({"help", "--man-pages", "/nonexistent"}), 3, {"/nonexistent"});
  for (const Words& command : {Words{"help", "--markdown", "render"}, Words{"help", "--markdown", "--man"},
                               Words{"help", "--markdown", "--man-pages", "."}})
    expect_error(fastsplat(command), 2, {"--markdown"});
  expect_error(fastsplat({"completion", "tcsh"}), 2, {"bash, zsh or fish"});
}

TEST(Examples, AllRun) {
  const TempFolder folder;
  // The files of the repository that examples use, small.
  fs::create_directories(folder.path() / "configs/plans");
  folder.write("configs/plans/word-lengths.toml",
               "kind = \"compare\"\n[constants]\nvolume = \"shells:16\"\nsize = 32\n[axes]\n"
               "snap.phases = [16, 64]\nradial.entries = [64, 1024]\n");
  fs::create_directory(folder.path() / "results");
  for (const char* day : {"yesterday.json", "today.json"}) {
    folder.write(
        day, R"({"format": "fastsplat coverage 1", "config": "tiny", "config_hash": "1", "streams": 1, "splats": 1,)"
             R"( "comparisons": 1, "cycles": 1, "campaigns": {"hazards": {"hazard.distance_1": 1}}})");
  }
  const bool scans = fastsplat({"volume", "info", "ch2bet"}).code == 0;
  int ran = 0, slow = 0, skipped = 0;
  for (const auto& subcommand : cli::describe()) {
    for (const auto& example : subcommand.examples) {
      if (example.speed == cli::Example::Slow) {
        ++slow;  // Help.BeginsWithExamplesThatParse has it
        continue;
      }
      if (!scans && example.command.find("ch2") != std::string::npos) {
        ++skipped;
        continue;
      }
      SCOPED_TRACE(example.command);
      Surroundings here;
      here.folder = folder.path();
      here.environment = {"PATH=" + fs::path(program()).parent_path().string() + ":" + std::getenv("PATH")};
      const auto result = run_words({"sh", "-c", example.command}, here);
      EXPECT_EQ(result.code, 0) << result.out << result.err;
      ++ran;
    }
  }
  std::printf("[figure] examples = %d (limit > 40), slow and only parsed = %d, without their scan = %d\n", ran, slow,
              skipped);
  EXPECT_GT(ran, 40);
}

TEST(Install, PutsProgramModulePagesAndCompletionInPlace) {
  const TempFolder folder;
  const auto installed = run_words(
      {"cmake", "--install", FASTSPLAT_BINARY_DIR, "--component", "command", "--prefix", folder.path().string()});
  ASSERT_EQ(installed.code, 0) << installed.err;
  for (const char* file : {"bin/fastsplat", "share/man/man1/fastsplat.1", "share/man/man1/fastsplat-stream-record.1",
                           "share/bash-completion/completions/fastsplat", "share/zsh/site-functions/_fastsplat",
                           "share/fish/vendor_completions.d/fastsplat.fish"}) {
    EXPECT_TRUE(fs::exists(folder.path() / file)) << file;
  }
  // The installed program is this one, and it finds its module.
  EXPECT_EQ(read_bytes(folder / "share/bash-completion/completions/fastsplat"), fastsplat({"completion", "bash"}).out);
  EXPECT_EQ(read_bytes(folder / "share/man/man1/fastsplat-render.1"), fastsplat({"help", "--man", "render"}).out);
  expect_success(
      run_words({folder / "bin/fastsplat", "render", "--volume", "shells:8", "--size", "8", "-o", folder / "a.png"}));
  EXPECT_TRUE(fs::exists(folder / "a.png"));
  // It has the sources of the RTL, too.
  Surroundings cache;
  cache.environment = {"XDG_CACHE_HOME=" + (folder / "cache")};
  const auto verified = run_words({folder / "bin/fastsplat", "verify", "--random", "100", "--config", "tiny"}, cache);
  expect_success(verified);
  EXPECT_NE(verified.err.find("building the simulator of configuration tiny"), std::string::npos) << verified.err;
  if (!has("man")) return;
  Surroundings here;
  here.environment = {"MANPAGER=cat", "MANWIDTH=80"};
  const auto page = run_words({"man", "-M", folder / "share/man", "fastsplat-compare"}, here);
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_NE(page.out.find("--min-psnr"), std::string::npos) << page.out;
}

}  // namespace
}  // namespace fastsplat::cli_test
