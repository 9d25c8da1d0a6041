// SPDX-License-Identifier: Apache-2.0
// ./run and the scripts in tools/: each prints its help; unknown arguments are refused before anything is installed,
// configured or built. They run in a copied tree, among programs that only record their calls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// A copy of ./run and tools/ with their data files, and nothing that could be built.
class Tree {
 public:
  Tree() {
    fs::copy_file(kSource / "run", folder_ / "run");
    fs::copy(kSource / "tools", folder_ / "tools");
    for (const char* part : {"docs", "tests", "rtl", "tools/benchmarks", "tools/helpers", "CMakePresets.json"})
      fs::create_symlink(kSource / part, folder_ / part);
    fs::create_directory(folder_ / "stubs");
    for (const char* tool : {"cmake", "ninja", "apt-get", "apt-cache", "dpkg-query", "sudo"}) put(tool, "exit 1");
    before_ = folder_.entries();
  }

  /// Shadows a program of the system; it writes its name into `called` first.
  void put(const std::string& tool, const std::string& script) const {
    const std::string path = folder_.write(
        "stubs/" + tool, "#!/bin/sh\necho " + tool + " >>'" + (folder_ / "called") + "'\n" + script + "\n");
    fs::permissions(path, fs::perms::owner_all);
  }

  Result run(const Words& words) const {
    Surroundings here;
    here.folder = folder_.path();
    here.environment = {"PATH=" + (folder_ / "stubs") + ":" + std::getenv("PATH")};
    // Scripts of tools/ are called by name; all else are commands of ./run.
    const bool tool = fs::exists(folder_.path() / "tools" / words.front());
    Words all{folder_ / (tool ? "tools/" + words.front() : "run")};
    all.insert(all.end(), words.begin() + (tool ? 1 : 0), words.end());
    return run_words(all, here);
  }

  /// Nothing was created in the tree, and none of the programs was called.
  void expect_untouched() const { EXPECT_EQ(folder_.entries(), before_); }
  std::string operator/(const std::string& name) const { return folder_ / name; }

 private:
  inline static const fs::path kSource = FASTSPLAT_SOURCE_DIR;
  TempFolder folder_;
  Words before_;
};

std::string joined(const Words& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

void expect_refusal(const Result& result, const Words& parts) {
  EXPECT_EQ(result.code, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("error: "), std::string::npos) << result.err;
  for (const auto& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos) << "'" << part << "' is not in: " << result.err;
}

/// Subcommand and line, as ./run help lists them.
std::vector<std::pair<std::string, std::string>> listed(const Tree& tree) {
  std::vector<std::pair<std::string, std::string>> subcommands;
  std::istringstream lines(tree.run({"help"}).out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string door, subcommand;
    words >> door >> subcommand;
    if (door == "./run") subcommands.emplace_back(subcommand, line);
  }
  return subcommands;
}

TEST(RunCommands, EachPrintsItsHelpAndBuildsNothing) {
  const Tree tree;
  const auto subcommands = listed(tree);
  for (const auto& [subcommand, line] : subcommands) {
    SCOPED_TRACE(subcommand);
    const auto result = tree.run({subcommand, "--help"});
    expect_success(result);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out.rfind(line + "\n", 0), 0U) << result.out;
    if (subcommand == "help") continue;
    for (const char* part : {"usage:", "\n    writes: ", "\n    takes:  "})
      EXPECT_NE(result.out.find(part), std::string::npos) << "no '" << part << "' in " << result.out;
    EXPECT_EQ(result.out.find("\n./run "), std::string::npos) << "another verb's line in " << result.out;
  }
  tree.expect_untouched();
  std::printf("[figure] commands of ./run with help = %zu (limit 6)\n", subcommands.size());
  EXPECT_EQ(subcommands.size(), 6U);
}

TEST(RunCommands, EachToolPrintsItsHelpAndIsListed) {
  const Tree tree;
  const std::string page = read_bytes(tree / "tools/README.md");
  int tools = 0;
  for (const auto& entry : fs::directory_iterator(tree / "tools")) {
    const std::string name = entry.path().filename();
    if (!entry.is_regular_file() || entry.path().has_extension()) continue;
    SCOPED_TRACE(name);
    const auto result = tree.run({name, "--help"});
    expect_success(result);
    for (const char* part : {"usage:  tools/", "writes: ", "takes:  "})
      EXPECT_NE(result.out.find(part), std::string::npos) << "no '" << part << "' in " << result.out;
    EXPECT_NE(page.find("| `tools/" + name + "` |"), std::string::npos);
    ++tools;
  }
  tree.expect_untouched();
  std::printf("[figure] tools with help = %d (limit > 9)\n", tools);
  EXPECT_GT(tools, 9);
}

TEST(RunCommands, TheScriptHasTheCommandsThatItLists) {
  const Tree tree;
  std::set<std::string> shown, had;
  for (const auto& [subcommand, line] : listed(tree)) shown.insert(subcommand);
  const std::string script = read_bytes(tree / "run");
  const std::string doors = script.substr(script.rfind("\ncase $verb in\n"));
  static const std::regex door(R"(\n  ([a-z]+)\))");
  for (auto at = std::sregex_iterator(doors.begin(), doors.end(), door); at != std::sregex_iterator(); ++at)
    had.insert((*at)[1]);
  EXPECT_EQ(shown, had);
}

TEST(RunCommands, HelpBehindOtherArgumentsIsHelp) {
  const Tree tree;
  EXPECT_EQ(tree.run({"test", "-L", "fast", "-h"}).out, tree.run({"test", "--help"}).out);
  tree.expect_untouched();
}

TEST(RunCommands, UnknownCommandsAreRefusedAndNothingIsBuilt) {
  const Tree tree;
  const std::vector<std::pair<Words, Words>> wrong{
      {{"nosuch"}, {"command 'nosuch'", "./run help"}},
      {{"nosuch", "--help"}, {"command 'nosuch'", "./run help"}},
      {{"help", "nosuch"}, {"help", "no arguments", "nosuch"}},
      {{"evidence", "nosuch"}, {"evidence: unknown part 'nosuch'", "proofs", "page"}},
      {{"test", "--nosuch"}, {"test", "--nosuch", "-R NAME"}},
      {{"test", "base_fast"}, {"test", "base_fast", "-R NAME"}},
      {{"test", "-j2", "--nosuch"}, {"test", "--nosuch", "-R NAME"}},
      {{"test", "-L", "fast", "base"}, {"test", "'base'", "-R NAME"}},
      {{"bench", "rtl"}, {"bench", "rtl", "--benchmark_filter"}},
      {{"performance", "--nosuch"}, {"performance", "--nosuch", "--benchmark_filter"}},
      {{"peers", "vtk"}, {"peers", "vtk", "--benchmark_filter"}},
      {{"netlist", "nosuch"}, {"netlist", "nosuch", "westover"}},
      {{"netlist", "small", "--nosuch"}, {"netlist", "--nosuch", "westover"}},
      {{"synth", "ice40"}, {"synth", "ice40", "xc7-cull_pixel"}},
      {{"synth", "xc7-base", "xc7-nosuch"}, {"synth", "xc7-nosuch", "hx8k-hx8k"}},
      {{"mutate", "--nosuch"}, {"mutate", "--nosuch", "tools/mutate --help"}},
      {{"mutate", "--seed", "x"}, {"mutate", "--seed", "x"}},
      {{"mutate", "--module", "nosuch"}, {"mutate", "nosuch", "compositor"}},
      {{"build", "--nosuch"}, {"build", "--nosuch", "-jN"}},
      {{"fuzz", "--nosuch"}, {"fuzz", "--nosuch", "--seconds"}},
      {{"fuzz", "--seconds", "0"}, {"fuzz", "--seconds", "'0'"}},
      {{"fuzz", "nosuch"}, {"fuzz", "nosuch", "transfer_function"}},
      {{"sanitize", "base"}, {"sanitize", "'base'", "base_fast"}},
      {{"sanitize", "base_slow"}, {"sanitize", "base_slow", "base_fast"}},  // base has no slow tests
      {{"gallery", "nosuch"}, {"gallery", "nosuch", "docs/gallery.toml"}},
      {{"gallery", "terrain", "nosuch"}, {"gallery", "nosuch", "docs/gallery.toml"}},
      {{"coverage", "nosuch.json"}, {"coverage", "nosuch.json", "files"}},
      {{"timing", "nosuch"}, {"timing", "'nosuch'", "--check"}},
      {{"timing", "--check", "check"}, {"timing", "'--check check'"}},
  };
  for (const auto& [words, parts] : wrong) {
    SCOPED_TRACE(joined(words));
    expect_refusal(tree.run(words), parts);
  }
  tree.expect_untouched();
}

// Known packages get as far as the package manager, of which this tree has none.
TEST(RunCommands, KnownCommandsAreRun) {
  const std::vector<Words> right{{"test", "-L", "fast", "-R", "Name", "-j2", "--timeout=9", "-VV"},
                                 {"bench", "--benchmark_filter=rtl"},
                                 {"netlist", "small", "cull"},
                                 {"synth", "xc7-cull_pixel", "hx8k-tiny"},
                                 {"evidence", "refusals", "page"},
                                 {"mutate", "--module", "csr", "--seed", "3"},
                                 {"build", "-j1", "-k0", "fastsplat"},
                                 {"fuzz", "--seconds", "1", "volume", "--jobs", "2", "--keep"},
                                 {"sanitize", "fast", "cmodel_slow"},
                                 {"gallery", "terrain"},
                                 {"coverage", "run"},
                                 {"timing", "--check"},
                                 {"demo", "--size", "64"},
                                 {"fastsplat", "render", "--help"}};
  for (const Words& words : right) {
    SCOPED_TRACE(joined(words));
    const Tree tree;
    const auto result = tree.run(words);
    EXPECT_NE(result.code, 2) << result.err;
    ASSERT_TRUE(fs::exists(tree / "called")) << result.err;
    EXPECT_NE(read_bytes(tree / "called").find("dpkg-query"), std::string::npos);
  }
}

/// A build of Ninja's with one target, and a second once the file `more` is there.
void put_build(const Tree& tree) {
  tree.put("dpkg-query", R"(for name; do case $name in -*) ;; *) echo "$name installed" ;; esac; done)");
  tree.put("cmake", R"(while [ "$1" != -B ]; do shift; done
cat >"$2/configure" <<'TEXT'
{ cat <<'RULES'
rule configure
  command = sh ./configure
  generator = 1
rule make
  command = touch $out
build build.ninja: configure | ../more
build one: make
RULES
[ ! -s ../more ] || echo 'build two: make'; } >build.ninja
TEXT
: >"$2/../more"
cd "$2" && sh ./configure)");
  fs::remove(tree / "stubs/ninja");  // the system's own
}

TEST(RunCommands, UnknownTargetsAreRefusedBeforeTheBuild) {
  const Tree tree;
  put_build(tree);
  expect_success(tree.run({"build", "-j1", "one"}));
  EXPECT_TRUE(fs::exists(tree / "build/one"));
  fs::remove(tree / "build/one");
  expect_refusal(tree.run({"build", "one", "two"}), {"build", "'two'", "targets"});
  EXPECT_FALSE(fs::exists(tree / "build/one"));
  // Files changed since the build last looked at them.
  std::ofstream(tree / "more") << "a target\n";
  expect_success(tree.run({"build", "one", "two"}));
  EXPECT_TRUE(fs::exists(tree / "build/two"));
}

}  // namespace
}  // namespace fastsplat::cli_test
