// SPDX-License-Identifier: Apache-2.0
// Subcommands that take a configuration: config diff, --set beside --config, the name of a changed configuration.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/hash_text.hpp"
#include "base/images/image_file.hpp"
#include "cli/command_line.hpp"
#include "driver/config/config_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::json;

struct Said {
  ExitCode code;
  std::string out;
};

Said said(const std::vector<std::string>& words) {
  std::vector<const char*> all{"fastsplat"};
  for (const auto& word : words) all.push_back(word.c_str());
  all.push_back(nullptr);
  const auto action = parse(static_cast<int>(all.size()) - 1, all.data());
  ::testing::internal::CaptureStdout();
  try {
    const auto code = action();
    return {code, ::testing::internal::GetCapturedStdout()};
  } catch (...) {
    ::testing::internal::GetCapturedStdout();
    throw;
  }
}

TEST(ConfigDiff, EqualIsAPass) {
  const auto [code, out] = said({"config", "diff", "base", "base", "--json", "-"});
  EXPECT_EQ(code, ExitCode::Pass);
  const auto json = Json::parse(out);
  EXPECT_TRUE(json.at("equal").get<bool>());
  EXPECT_TRUE(json.at("differences").empty());
}

TEST(ConfigDiff, ListsEveryKeyThatDiffersAndNoOther) {
  const auto [code, out] = said({"config", "diff", "base", "wide", "--json", "-"});
  EXPECT_EQ(code, ExitCode::Failed);
  const auto base = driver::load_config("base"), wide = driver::load_config("wide");
  const auto json = Json::parse(out);
  EXPECT_FALSE(json.at("equal").get<bool>());
  EXPECT_EQ(json.at("b").at("hash"), hash_text(cmodel::config_hash(wide)));
  std::size_t differ = 0;
  for (const auto& key : cmodel::config_keys()) {
    if (base.*key.member == wide.*key.member) continue;
    ASSERT_LT(differ, json.at("differences").size()) << key.name << " is not listed";
    const auto& listed_key = json.at("differences").at(differ++);
    EXPECT_EQ(listed_key.at("key"), key.name);
    EXPECT_EQ(listed_key.at("a"), base.*key.member);
    EXPECT_EQ(listed_key.at("b"), wide.*key.member);
  }
  EXPECT_EQ(differ, json.at("differences").size());
  std::printf("[figure] keys in which base and wide differ = %zu (limit > 0)\n", differ);
  EXPECT_GT(differ, 0u);
}

// The names differ, the device is the same.
TEST(ConfigDiff, ANameIsNotADifference) {
  const cli_test::TempFolder folder;
  auto config = driver::load_config("tiny");
  config.name = "mine";
  const auto file = folder.write("mine.toml", driver::to_toml(config));
  EXPECT_EQ(said({"config", "diff", "tiny", file}).code, ExitCode::Pass);
  config.radial_entries *= 2;
  const auto other = folder.write("other.toml", driver::to_toml(config));
  const auto [code, out] = said({"config", "diff", file, other});
  EXPECT_EQ(code, ExitCode::Failed);
  EXPECT_NE(out.find("differ in 1 key\n  radial.entries"), std::string::npos) << out;
}

TEST(ConfigShow, PrintsAChangedConfigurationThatIsReadBack) {
  const cli_test::TempFolder folder;
  const auto [code, out] = said({"config", "show", "tiny", "--set", "radial.entries=128", "--set=rlut.sets=2"});
  EXPECT_EQ(code, ExitCode::Pass);
  const auto config = driver::load_config(folder.write("changed.toml", out));
  EXPECT_EQ(config.radial_entries, 128);
  EXPECT_EQ(config.rlut_sets, 2);
  EXPECT_EQ(config.name, "tiny+rlut.sets=2+radial.entries=128");
}

std::string help_of(const Subcommand& subcommand) {
  std::vector<std::string> words{"help"};
  std::istringstream names(subcommand.name);
  for (std::string word; names >> word;) words.push_back(word);
  return said(words).out;
}

TEST(Set, IsWhereverAConfigurationIsNamed) {
  int subcommands = 0;
  for (const Subcommand& subcommand : all_subcommands()) {
    const auto help = help_of(subcommand);
    const std::string name = subcommand.name;
    const bool named =
        help.find("--config NAME") != std::string::npos || name == "config show" || name == "config check";
    EXPECT_EQ(help.find("--set KEY=VALUE") != std::string::npos, named) << name;
    subcommands += named ? 1 : 0;
  }
  std::printf("[figure] verbs with --set = %d (limit >= 7)\n", subcommands);
  EXPECT_GE(subcommands, 7);
}

TEST(Index, IsShortForSetWhereverThatIs) {
  int subcommands = 0;
  for (const Subcommand& subcommand : all_subcommands()) {
    const auto help = help_of(subcommand);
    const bool set = help.find("--set KEY=VALUE") != std::string::npos;
    EXPECT_EQ(help.find("--index KIND") != std::string::npos, set) << subcommand.name;
    subcommands += set ? 1 : 0;
  }
  std::printf("[figure] verbs with --index = %d (limit >= 7)\n", subcommands);
  EXPECT_GE(subcommands, 7);
  const auto config = [](const std::string& text) {
    const cli_test::TempFolder folder;
    return driver::load_config(folder.write("changed.toml", text));
  };
  const auto index = said({"config", "show", "tiny", "--index", "linear"});
  const auto set = said({"config", "show", "tiny", "--set", "index.kind=linear"});
  EXPECT_EQ(index.code, ExitCode::Pass);
  EXPECT_EQ(config(index.out), config(set.out));
  EXPECT_EQ(config(index.out).name, "tiny+index.kind=linear");
}

// N-2-8 for engine rtl: index.kind.
TEST(Index, IsRefusedInOneLineWhereItCannotBe) {
  struct Case {
    std::vector<std::string> words, said;
  };
  const std::vector<std::string> view{"--volume", "shells:8", "--size", "16"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), view.begin(), view.end());
    return words;
  };
  int refused = 0;
  for (const auto& [words, parts] :
       {Case{{"config", "show", "tiny", "--index", "rlutt"},
             {"--index: expected", "squared_elliptic", "did you mean 'rlut'"}},
        Case{{"config", "show", "base", "--index", "blit2d"}, {"--index blit2d: snap.phases", "16777216", "67108864"}},
        Case{{"config", "show", "tiny", "--set", "index.symmetry=eightfold"}, {"blit2d", "got rlut"}},
        Case{{"config", "show", "tiny", "--index", "linear", "--set", "index.kind=squared"}, {"set twice"}},
        Case{with({"cycles", "--index", "squared"}), {"index.kind", "rlut, blit2d or separable", "got squared"}},
        Case{with({"render", "--engine", "rtl", "--index", "separable", "-o", "a.exr"}),
             {"index.kind", "got separable", "--engine cmodel"}},
        Case{{"verify", "--random", "1", "--index", "blit2d", "--set", "snap.phases=4"},
             {"index.kind", "got blit2d"}}}) {
    std::string line;
    try {
      said(words);
    } catch (const UserError& error) {
      line = error.what();
    }
    EXPECT_FALSE(line.empty()) << words.front() << " is taken";
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    for (const std::string& part : parts)
      EXPECT_NE(line.find(part), std::string::npos) << part << " is not in: " << line;
    ++refused;
  }
  std::printf("[figure] refusals read = %d\n", refused);
}

TEST(TypedNames, AnErrorNamesTheFlagOrKeyThatTheUserGave) {
  const cli_test::TempFolder folder;
  const auto file =
      folder.write("scene.toml", "volume = \"shells:8\"\nmethod = \"xray\"\n[classify]\norder = \"post\"\n");
  const auto crop = folder.write("crop.toml", "volume = \"shells:8\"\n");
  int named = 0;
  for (const auto& [words, begin] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"render", "--volume", "shells:8", "--classify", "post", "--method=xray", "-o", "a.exr"}, "--classify: "},
           {{"render", "--scene", crop, "--crop", "0..9,0..9,0..9", "-o", "a.exr"}, "--crop: "},
           {{"render", "--scene", file, "-o", "a.exr"}, "classify.order: "},
           {{"render", "--volume", "shells:8", "--method", "raycast", "--engine", "cmodel", "-o", "a.exr"},
            "--method: "},
           {{"render", "--volume", "shells:8", "--index", "rlut", "-o", "a.exr"}, "--index rlut: "},
           {{"render", "--volume", "shells:8", "--set", "index.kind=rlut", "-o", "a.exr"}, "--set index.kind=rlut: "},
           {{"render", "--volume", "shells:8", "--perspective", "--zoom", "9", "-o", "a.exr"}, "--zoom: "},
           {{"family", "--kind", "rlutt"}, "--kind: "},
           {{"family", "--entries", "100"}, "--entries: "}}) {
    std::string line = "accepted";
    try {
      said(words);
    } catch (const UserError& error) {
      line = error.what();
    }
    EXPECT_TRUE(line.starts_with(begin)) << line << "\n  does not begin with " << begin;
    ++named;
  }
  std::printf("[figure] errors that name what was typed = %d\n", named);
}

TEST(Set, NamesTheConfigurationOfAPicture) {
  const cli_test::TempFolder folder;
  const auto picture = folder / "a.exr";
  const auto [code, out] = said({"render", "--volume", "point:4", "--size", "8", "--engine", "cmodel", "--config",
                                 "tiny", "--set", "radial.entries=128", "-o", picture, "--json", "-", "--quiet"});
  EXPECT_EQ(code, ExitCode::Pass);
  auto config = driver::load_config("tiny");
  config.radial_entries = 128;
  const auto hash = hash_text(cmodel::config_hash(config));
  const auto json = Json::parse(out);
  EXPECT_EQ(json.at("config").at("name"), "tiny+radial.entries=128");
  EXPECT_EQ(json.at("config").at("hash"), hash);
  const auto metadata = images::read_image(picture).metadata;
  EXPECT_EQ(metadata.at("config"), "tiny+radial.entries=128");
  EXPECT_EQ(metadata.at("config_hash"), hash);
}

}  // namespace
}  // namespace fastsplat::cli
