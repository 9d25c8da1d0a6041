// The list of settings: limits, flags, scene.toml, for whatever the list holds.
#include "scene/settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

using SavedSettings = TemporaryFolder;

/// Values just outside a setting's limits, as the text of a flag; NaN is no text.
template <class Kind>
std::vector<double> outside(const Kind& kind) {
  if constexpr (std::is_same_v<Kind, Integer>) return {kind.low - 1.0, kind.high + 1.0};
  return {kind.low - 1e-3 * (std::abs(kind.low) + 1), kind.high * 1.01 + 1e-9};
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

/// Some text for a flag that is not the default.
std::string another_text(const Setting& setting) {
  const SceneDescription d;
  if (const auto* choice = std::get_if<Choice>(&setting.value)) {
    const auto& names = choice->names();
    return names[static_cast<std::size_t>(choice->get(d) + 1) % names.size()];
  }
  if (const auto* real = std::get_if<Real>(&setting.value)) {
    return fmt::format("{}", real->low + (real->high - real->low) / 3.0);
  }
  if (const auto* integer = std::get_if<Integer>(&setting.value))
    return fmt::format("{}", std::min(integer->high, integer->low + 4));
  if (const auto* triple = std::get_if<Triple>(&setting.value)) {
    const double third = (triple->high - triple->low) / 3.0;
    return fmt::format("{},{},{}", triple->low + third, triple->low, triple->high);
  }
  return value_as_toml(setting, d) == "true" ? "off" : "on";
}

TEST_F(SavedSettings, EveryOneComesBackFromItsFlagAndFromTheSavedScene) {
  // One description with every setting changed by its text, saved, read again: equal setting by setting.
  SceneDescription changed;
  changed.kernel.clear();
  const SceneDescription plain;
  int changes = 0;
  for (const Setting& setting : settings()) {
    const std::string text = another_text(setting);
    ASSERT_EQ(problem_with(setting, text), "") << setting.key;
    set_from_text(setting, text, changed);
    ++changes;
    EXPECT_NE(value_as_toml(setting, changed), value_as_toml(setting, plain)) << setting.key;
  }
  const SceneDescription again = load_scene_file(write("scene.toml", to_toml(changed)));
  for (const Setting& setting : settings()) {
    EXPECT_EQ(value_as_toml(setting, again), value_as_toml(setting, changed)) << setting.table << '.' << setting.key;
  }
  EXPECT_EQ(to_toml(again), to_toml(changed));
  EXPECT_GE(changes, 17);
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
