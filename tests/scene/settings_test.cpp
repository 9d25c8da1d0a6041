// SPDX-License-Identifier: Apache-2.0
// The list of settings: limits, flags, scene.toml, for every setting in the list.
#include "scene/settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/scene/follow_fixes_testing.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

using SavedSettings = TemporaryFolder;

/// Values just outside a setting's limits, as the text of a flag; NaN cannot be written.
template <class Kind>
std::vector<double> outside(const Kind& kind) {
  if constexpr (std::is_same_v<Kind, Integer>) return {kind.low - 1.0, kind.high + 1.0};
  return {kind.low - 1e-3 * (std::abs(kind.low) + 1), kind.high * 1.01 + 1e-9};
}

TEST(Settings, AMistypedWordIsSuggested) {
  int words = 0;
  for (const Setting& setting : settings()) {
    std::vector<std::string> names;
    if (const auto* choice = std::get_if<Choice>(&setting.value)) names = choice->names();
    if (std::holds_alternative<Switch>(setting.value)) names = {"off"};
    for (const std::string& name : names) {
      if (name.size() < 3) continue;
      EXPECT_THAT(problem_with(setting, name.substr(0, name.size() - 1)), HasSubstr("did you mean '"))
          << setting.key << " " << name;
      ++words;
    }
  }
  std::printf("[figure] words mistyped = %d (limit > 20)\n", words);
  EXPECT_GT(words, 20);
}

TEST(Settings, LimitsAreCheckedForDescriptionsAndFlags) {
  int checked = 0;
  for (const Setting& setting : settings()) {
    const auto check = [&](const auto& kind) {
      for (const double bad : outside(kind)) {
        SceneDescription d;
        kind.of(d) = std::remove_cvref_t<decltype(kind.of(d))>(bad);
        EXPECT_THAT(refusal([&] { build_scene(d); }, ExitCode::Usage), HasSubstr(setting.key));
        const std::string text = fmt::format("{}", bad);
        const std::string triple = fmt::format("{},{},{}", text, text, text);
        const bool three = std::is_same_v<std::remove_cvref_t<decltype(kind)>, Triple>;
        EXPECT_THAT(problem_with(setting, three ? triple : text), HasSubstr("in ")) << setting.key;
        ++checked;
      }
    };
    if (const auto* real = std::get_if<Real>(&setting.value)) check(*real);
    if (const auto* integer = std::get_if<Integer>(&setting.value)) check(*integer);
    if (const auto* triple = std::get_if<Triple>(&setting.value)) check(*triple);
  }
  EXPECT_GE(checked, 26);
  RecordProperty("limits_checked", checked);
}

TEST_F(SavedSettings, EveryOneComesBackFromItsFlagAndFromTheSavedScene) {
  // Each setting changed by its text, in a scene where it has an effect; saved and read again: equal setting by
  // setting.
  const SceneDescription plain;
  int changes = 0;
  for (const Setting& setting : settings()) {
    ASSERT_EQ(problem_with(setting, setting.capability.probe), "") << setting.key;
    const Followed way = follow_fixes(setting, plain, kOffersAll, false);
    ASSERT_TRUE(way.accepted) << setting.key << ": " << way.refusals.back();
    EXPECT_FALSE(at_default(setting, way.with)) << setting.key;
    const SceneDescription again = load_scene_file(write("scene.toml", to_toml(way.with)));
    for (const Setting& each : settings()) {
      EXPECT_EQ(value_as_toml(each, again), value_as_toml(each, way.with)) << dotted(setting) << ": " << dotted(each);
    }
    EXPECT_EQ(to_toml(again), to_toml(way.with)) << setting.key;
    ++changes;
  }
  std::printf("[figure] settings_saved_and_read = %d (all of %zu)\n", changes, settings().size());
  EXPECT_GE(changes, 42);
}

TEST_F(SavedSettings, SettingsWithoutEffectAreNotSaved) {
  SceneDescription d;
  d.footprint.texture.phases = 48;  // as demo:fire --splat-texture 0 leaves it
  EXPECT_THAT(to_toml(d), ::testing::Not(HasSubstr("phases")));
  EXPECT_EQ(load_scene_file(write("scene.toml", to_toml(d))).footprint.texture.phases, 16);
}

TEST(Settings, NeitherKeysNorFlagsRepeat) {
  std::set<std::string> keys, flags;
  for (const Setting& setting : settings()) {
    EXPECT_TRUE(keys.insert(std::string(setting.table) + "." + setting.key).second) << setting.key;
    if (*setting.flag == '\0') continue;
    EXPECT_TRUE(flags.insert(setting.flag).second) << setting.flag;
  }
}

TEST(Settings, TextsThatAreRefused) {
  const auto problem = [](const std::string& flag, const std::string& text) {
    for (const Setting& setting : settings()) {
      if (flag == setting.flag) return problem_with(setting, text);
    }
    return std::string("no such flag");
  };
  EXPECT_EQ(problem("--zoom", "nan"), "expected a finite number, got 'nan'");
  EXPECT_EQ(problem("--zoom", "0"), "expected a number in 1e-06..1000000, got '0'");
  EXPECT_EQ(problem("--xray-sheets", "2.5"), "expected an integer in 1..65535, got '2.5'");
  EXPECT_EQ(problem("--method", "xrai"),
            "expected raycast, xray, westover, axis_aligned or image_aligned, got 'xrai'; did you mean 'xray'?");
  EXPECT_EQ(problem("--zoom", "+2"), "");
}

}  // namespace
}  // namespace fastsplat::scene
