// SPDX-License-Identifier: Apache-2.0
// Every reader of TOML is given every kind of TOML: another kind than its own is named in one line with its use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>

#include "analysis/sweep/spec.hpp"
#include "base/error.hpp"
#include "cli/command_line.hpp"
#include "driver/config/config_file.hpp"
#include "scene/scene.hpp"
#include "scene/settings.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/volume_file.hpp"
#include "testbench/closure/verification_plan.hpp"
#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;
using cli_test::TempFolder;
using ::testing::HasSubstr;

struct Kind {
  std::string name, use;
  std::vector<std::string> folders;  ///< of shipped files; or one file
  std::function<void(const std::string&)> read;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"a configuration",
       "--config",
       {"configs", "configs/faults"},
       [](const std::string& file) { driver::load_config(file); }},
      {"a scene",
       "--scene",
       {"scene/demos", "docs/examples/shapes"},
       [](const std::string& file) { scene::load_scene_file(file); }},
      {"a transfer function",
       "--tf",
       {"scene/presets"},
       [](const std::string& file) { scene::load_transfer_function(file); }},
      {"a plan", "plan make", {"configs/plans"}, [](const std::string& file) { plan::read_spec(file); }},
      {"a verification plan",
       "tools/coverage",
       {"docs/verification_plan.toml"},
       [](const std::string& file) { testbench::read_plan(file); }},
      {"a list of coverage exclusions",
       "tools/coverage",
       {"docs/coverage_exclusions.toml"},
       [](const std::string& file) { testbench::read_exclusions(file); }}};
  return all;
}

std::vector<std::string> files_of(const Kind& kind) {
  std::vector<std::string> files;
  for (const auto& name : kind.folders) {
    const fs::path path = fs::path(FASTSPLAT_SOURCE_DIR) / name;
    if (path.extension() == ".toml") {
      files.push_back(path);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(path)) {
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
  }
  return files;
}

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Input) << error.what();
    return error.what();
  }
  return "";
}

TEST(TomlKinds, EveryReaderNamesEveryOtherKind) {
  int refused = 0;
  for (const Kind& given : kinds()) {
    const auto files = files_of(given);
    ASSERT_FALSE(files.empty()) << given.name;
    for (const auto& file : files) {
      for (const Kind& reader : kinds()) {
        const auto message = refusal([&] { reader.read(file); });
        if (reader.name == given.name) {
          EXPECT_EQ(message, "");
        } else {
          EXPECT_THAT(message, HasSubstr(file + ": wrong kind of file (expected " + reader.name + ", got " +
                                         given.name + "); "));
          EXPECT_THAT(message, HasSubstr(given.use));
          ++refused;
        }
      }
    }
  }
  std::printf("[figure] files of another kind = %d (limit > 0)\n", refused);
}

// A key added to configurations or scenes shows the kind of its file as well, unless both have it.
TEST(TomlKinds, EveryTopLevelKeyShowsItsKind) {
  const TempFolder folder;
  std::set<std::string> configuration{"verified"}, scene{"volume", "transfer_function", "nan_as", "[sequence]"};
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    configuration.insert("[" + name.substr(0, name.find('.')) + "]");
  }
  for (const auto& setting : scene::settings())
    scene.insert(*setting.table == 0 ? setting.key : "[" + std::string(setting.table) + "]");
  for (const std::string shared : {"shading", "[classify]", "classify"}) {
    configuration.erase(shared);
    scene.erase(shared);
  }
  const auto check = [&](const std::set<std::string>& keys, const Kind& given, const Kind& reader) {
    for (const std::string& key : keys) {
      const auto file = folder.write("one.toml", key.starts_with("[") ? key + "\n" : key + " = \"\"\n");
      EXPECT_THAT(refusal([&] { reader.read(file); }), HasSubstr("got " + given.name)) << key;
    }
  };
  check(configuration, kinds()[0], kinds()[1]);
  check(scene, kinds()[1], kinds()[0]);
}

TEST(TomlKinds, FilesOfTheOwnKindKeepTheirMessages) {
  const TempFolder folder;
  const auto typo = folder.write("typo.toml", "volume = \"shells:8\"\nradial = 5\n");
  EXPECT_THAT(refusal([&] { scene::load_scene_file(typo); }), HasSubstr("typo.toml:2:1: unknown key 'radial'"));
  const auto unknown = folder.write("unknown.toml", "name = \"mine\"\nfoo = 5\n");
  EXPECT_THAT(refusal([&] { driver::load_config(unknown); }),
              HasSubstr("unknown key 'foo'; 'fastsplat config show base' prints all keys"));
}

TEST(TomlKinds, EveryFlagThatTakesAConfigurationSaysSo) {
  const std::string scene = FASTSPLAT_SOURCE_DIR "/scene/demos/fire.toml";
  for (std::vector<std::string> words : {std::vector<std::string>{"config", "check", scene},
                                         {"config", "show", scene},
                                         {"config", "diff", "base", scene},
                                         {"cycles", "--config", scene},
                                         {"errors", "--config", scene},
                                         {"verify", "--random", "10", "--config", scene},
                                         {"render", "--engine", "cmodel", "--config", scene, "-o", "none.png"}}) {
    std::vector<const char*> all{"fastsplat"};
    for (const auto& word : words) all.push_back(word.c_str());
    all.push_back(nullptr);
    EXPECT_THAT(refusal([&] { parse(static_cast<int>(all.size()) - 1, all.data())(); }),
                HasSubstr("expected a configuration, got a scene); use it with --scene"))
        << words[0] << " " << words[1];
  }
  EXPECT_THAT(refusal([&] { volume::load_volume(scene); }), HasSubstr("give a scene with --scene"));
}

}  // namespace
}  // namespace fastsplat::cli
