// SPDX-License-Identifier: Apache-2.0
// --set: name and hash of a changed configuration, and the message for an impossible change.
#include "cli/config_flags.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

TEST(ConfigFlags, ChangesAreMadeAndNamed) {
  const auto base = driver::load_config("base");
  const auto changed = load("base", {"radial.entries=256"});
  EXPECT_EQ(changed.radial_entries, 256);
  EXPECT_EQ(changed.name, "base+radial.entries=256");
  EXPECT_EQ(changed.verified, "nothing");
  EXPECT_NE(cmodel::config_hash(changed), cmodel::config_hash(base));
  auto same = base;
  same.radial_entries = 256;
  EXPECT_EQ(cmodel::config_hash(changed), cmodel::config_hash(same));
}

TEST(ConfigFlags, TheNameIsInTheOrderOfTheKeysWhateverTheOrderOfTheFlags) {
  const auto one = load("tiny", {"pixel.frac_bits=9", "tile.width=64", "position.int_bits=9"});
  const auto other = load("tiny", {"position.int_bits=9", "tile.width=64", "pixel.frac_bits=9"});
  EXPECT_EQ(one.name, "tiny+tile.width=64+position.int_bits=9+pixel.frac_bits=9");
  EXPECT_EQ(one, other);
}

TEST(ConfigFlags, ASettingOfTheSameValueChangesNothing) {
  const auto base = driver::load_config("base");
  EXPECT_EQ(load("base", {"radial.entries=" + std::to_string(base.radial_entries)}), base);
  EXPECT_EQ(load(ConfigFlags{}), base);
}

// tile.width = 33 alone is not a multiple of the lanes, and neither is rlut.columns = 15 with two lanes.
TEST(ConfigFlags, LimitsBetweenKeysHoldAfterTheLast) {
  EXPECT_THROW(load("tiny", {"tile.width=33"}), UserError);
  const auto changed = load("tiny", {"tile.width=33", "rlut.columns=15", "array.lanes=1"});
  EXPECT_EQ(changed.tile_width, 33);
  EXPECT_EQ(changed.rlut_columns, 15);
}

struct WrongChange {
  const char* name;
  std::vector<std::string> changes;
  std::vector<std::string> said;
};
void PrintTo(const WrongChange& misuse, std::ostream* out) { *out << misuse.name; }

class WrongSet : public ::testing::TestWithParam<WrongChange> {};

TEST_P(WrongSet, IsOneLineThatNamesIt) {
  try {
    load("base", GetParam().changes);
    FAIL() << "was accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    const std::string said = error.what();
    EXPECT_EQ(said.rfind("--set ", 0), 0u) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_FALSE(error.parts().fix.empty()) << said;
    for (const auto& word : GetParam().said)
      EXPECT_NE(said.find(word), std::string::npos) << "'" << word << "' is not in: " << said;
  }
}

INSTANTIATE_TEST_SUITE_P(
    ConfigFlags, WrongSet,
    ::testing::Values(WrongChange{"no_value", {"radial.entries"}, {"KEY=VALUE", "radial.entries=256"}},
                      WrongChange{"no_key", {"=3"}, {"KEY=VALUE"}},
                      WrongChange{"key_mistyped", {"radial.entires=256"}, {"did you mean 'radial.entries'"}},
                      WrongChange{"key_without_table", {"lanes=4"}, {"--set lanes=4"}},
                      WrongChange{"value_empty", {"radial.entries="}, {"2..65536"}},
                      WrongChange{"value_no_number", {"radial.entries=many"}, {"2..65536", "got many"}},
                      WrongChange{"value_with_fraction", {"radial.entries=2.5"}, {"got 2.5"}},
                      WrongChange{"value_out_of_range", {"radial.entries=1"}, {"2..65536", "got 1"}},
                      WrongChange{"value_huge", {"radial.entries=99999999999"}, {"2..65536"}},
                      WrongChange{"value_no_power_of_two", {"radial.entries=200"}, {"a power of two", "128 or 256"}},
                      WrongChange{"key_twice", {"rlut.sets=2", "rlut.sets=3"}, {"--set rlut.sets=3", "set twice"}},
                      WrongChange{"limit_between_keys",
                                  {"rlut.sets=2", "tile.width=33"},
                                  {"--set rlut.sets=2 --set tile.width=33", "tile.width", "a multiple of"}}),
    [](const auto& misuse) { return misuse.param.name; });

}  // namespace
}  // namespace fastsplat::cli
