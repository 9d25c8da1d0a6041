// SPDX-License-Identifier: Apache-2.0
// Every limit of a configuration, broken once: the message names the key and has both numbers.
#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

void expect_violation(const cmodel::Config& config, const std::string& key, const std::string& expected,
                      const std::string& got) {
  const auto violation = cmodel::first_violation(config);
  ASSERT_TRUE(violation) << key << " = " << got << " is taken";
  const std::string line = one_line(*violation);
  EXPECT_NE(line.find(key), std::string::npos) << line;
  EXPECT_NE(violation->expected.find(expected), std::string::npos) << line << " lacks " << expected;
  EXPECT_EQ(violation->got, got) << line;
  EXPECT_FALSE(violation->fix.empty()) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(ConfigLimits, NamedConfigurationsAreSound) {
  ASSERT_EQ(config_names(), (std::vector<std::string>{"base", "compact", "ellipse", "exact", "fine", "hx8k", "small",
                                                      "tiny", "wide", "year2000"}));
  for (const std::string& name : config_names()) {
    const auto violation = cmodel::first_violation(named_config(name));
    EXPECT_FALSE(violation) << name << ": " << one_line(*violation);
  }
}

// N-2-1, N-2-7: the limits of the keys.
TEST(ConfigLimits, EveryKeyBelowAboveAndBetweenPowers) {
  int broken = 0;
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    cmodel::Config config = named_config("base");
    for (const int value : {key.min - 1, key.max + 1, -1, 2147483647, -2147483647 - 1}) {
      if (value >= key.min && value <= key.max) continue;
      config.*key.member = value;
      expect_violation(
          config, key.name,
          key.names.empty() ? std::to_string(key.min) + ".." + std::to_string(key.max) : cmodel::allowed(key),
          std::to_string(value));
      ++broken;
    }
    if (key.power_of_two && key.max >= 4) {
      config.*key.member = 3;
      expect_violation(config, key.name, "power of two", "3");
      ++broken;
    }
  }
  std::printf("[figure] key limits broken and refused = %d\n", broken);
  EXPECT_GE(broken, 4 * static_cast<int>(cmodel::config_keys().size()));
}

struct Between {
  const char* key;
  const char* expected;
  const char* got;
  void (*violate)(cmodel::Config&);
};

/// The configuration that has ellipses; every limit of them holds.
void with_ellipses(cmodel::Config& c) {
  oracle::Symbols symbols = symbols_of(c);
  symbols.f = 11;
  c = config_of(symbols, c.name);
}

/// No violation alone, with an even tile.
void ties_to_even_pixels(cmodel::Config& c) {
  c.lanes = c.phases = 1;
  c.rounding_snap = static_cast<int>(cmodel::Rounding::RND_CONV);
}

const Between kBetween[] = {
    {"tile.width", "multiple of 8", "100", [](cmodel::Config& c) { c.tile_width = 100; }},
    {"tile.height", "multiple of 8", "4", [](cmodel::Config& c) { c.tile_height = 4; }},
    {"rlut.columns", "multiple of 8", "12", [](cmodel::Config& c) { c.rlut_columns = 12; }},
    {"snap.phases", "64", "128", [](cmodel::Config& c) { c.phases = 128; }},
    {"rlut.columns", "2", "1",
     [](cmodel::Config& c) {
       c.lanes = 1;
       c.rlut_columns = 1;
       c.phases = 1;
     }},
    {"position.int_bits", "256", "128", [](cmodel::Config& c) { c.position_int_bits = 8; }},
    {"sheet.frac_bits", "32", "33",
     [](cmodel::Config& c) {
       c.sheet_int_bits = 3;
       c.sheet_frac_bits = 30;
     }},
    {"pixel.frac_bits", "32", "33",
     [](cmodel::Config& c) {
       c.pixel_int_bits = 2;
       c.pixel_frac_bits = 31;
     }},
    {"opacity.segments", "2^6", "128",
     [](cmodel::Config& c) {
       c.sheet_int_bits = 2;
       c.sheet_frac_bits = 4;
       c.opacity_segments = 128;
     }},
    {"rounding.snap", "even", "65",
     [](cmodel::Config& c) {
       ties_to_even_pixels(c);
       c.tile_width = 65;
     }},
    {"rounding.snap", "even", "67",
     [](cmodel::Config& c) {
       ties_to_even_pixels(c);
       c.tile_height = 67;
     }},
    {"composite.freeze_below", "65536", "65537", [](cmodel::Config& c) { c.freeze_below = 65537; }},
    {"index.symmetry", "blit2d", "rlut",
     [](cmodel::Config& c) { c.index_symmetry = static_cast<int>(cmodel::IndexSymmetry::Eightfold); }},
    {"snap.phases", "16777216", "67108864",
     [](cmodel::Config& c) { c.index_kind = static_cast<int>(cmodel::IndexKind::Blit2d); }},
    {"rlut.guard_bits", "31", "32",
     [](cmodel::Config& c) {
       c.index_kind = static_cast<int>(cmodel::IndexKind::Linear);
       c.position_frac_bits = 12;
       c.rlut_columns = 512;
       c.rlut_guard_bits = 11;
     }},
    {"position.frac_bits", "17", "18",
     [](cmodel::Config& c) {
       c.index_kind = static_cast<int>(cmodel::IndexKind::Squared);
       c.position_frac_bits = 11;
     }},
    {"position.frac_bits", "17", "18",
     [](cmodel::Config& c) {
       c.index_kind = static_cast<int>(cmodel::IndexKind::SquaredElliptic);
       c.position_frac_bits = 11;
     }},
    {"ellipse.frac_bits", "linear", "linear",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.index_kind = static_cast<int>(cmodel::IndexKind::Linear);
     }},
    {"position.frac_bits", "9", "10",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.position_frac_bits = 10;
     }},
    {"position.frac_bits", "22", "23",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.position_int_bits = 14;
       c.position_frac_bits = 9;
     }},
    {"rlut.columns", "256", "264",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.rlut_columns = 264;
     }},
    {"rlut.columns", "510", "512",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.lanes = 16;
       c.rlut_columns = 512;
     }},
    {"radial.entries", "2", "2",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.radial_entries = 2;
       c.rlut_guard_bits = 0;
     }},
    {"position.frac_bits", "21", "24",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.position_frac_bits = 0;
       c.phases = 1;
       c.rlut_guard_bits = 10;
     }},
    {"ellipse.frac_bits", "60", "61",
     [](cmodel::Config& c) {
       with_ellipses(c);
       c.position_frac_bits = 8;
       c.rlut_guard_bits = 12;
       c.radial_entries = 2048;
       c.ellipse_frac_bits = 20;
       c.lanes = 16;
     }},
    {"composite.lanes", "a divisor of array.lanes^2 = 64", "3", [](cmodel::Config& c) { c.composite_lanes = 3; }},
    {"composite.lanes", "a divisor of array.lanes^2 = 64", "128", [](cmodel::Config& c) { c.composite_lanes = 128; }},
    {"composite.lanes", "0 or array.lanes^2 = 64 with composite.every_sample = 1", "16",
     [](cmodel::Config& c) {
       c.composite_every_sample = 1;
       c.composite_lanes = 16;
     }},
    {"radial.interpolate", "rlut, squared or squared_elliptic", "blit2d",
     [](cmodel::Config& c) {
       c.radial_interpolate = 1;
       c.index_kind = static_cast<int>(cmodel::IndexKind::Blit2d);
       c.phases = 16;
     }},
    {"radial.interpolate", "rlut, squared or squared_elliptic", "separable",
     [](cmodel::Config& c) {
       c.radial_interpolate = 1;
       c.index_kind = static_cast<int>(cmodel::IndexKind::Separable);
     }},
    {"radial.interpolate", "rlut, squared or squared_elliptic", "linear",
     [](cmodel::Config& c) {
       c.radial_interpolate = 1;
       c.index_kind = static_cast<int>(cmodel::IndexKind::Linear);
     }},
    {"sheet.frac_bits", "18", "17",
     [](cmodel::Config& c) {
       c.classify_segment_bits = 9;
       c.sheet_frac_bits = 17;
       c.sheet_int_bits = 1;
     }},
    {"sheet.frac_bits", "int_bits + frac_bits <= 18", "16",
     [](cmodel::Config& c) {
       c.classify_segment_bits = 9;
       c.sheet_frac_bits = 16;
       c.sheet_int_bits = 3;
     }},
    {"classify.segment_bits", "8", "9",
     [](cmodel::Config& c) {
       c.classify_segment_bits = 9;
       c.sheet_frac_bits = 8;
     }},
    {"tile.width", "3", "2",
     [](cmodel::Config& c) {
       c.classify_segment_bits = 9;
       c.lanes = c.tile_width = c.tile_height = 2;
     }},
    {"tile.height", "3", "2",
     [](cmodel::Config& c) {
       c.classify_segment_bits = 9;
       c.lanes = c.tile_height = 2;
     }},
    {"cull.map", "off", "block",  // M-density-2
     [](cmodel::Config& c) {
       c.classify_segment_bits = 9;
       c.cull_map = static_cast<int>(cmodel::CullMap::Block);
     }},
    {"rlut.guard_bits", "1", "0",
     [](cmodel::Config& c) {
       c.radial_interpolate = 1;
       c.rlut_guard_bits = 0;
     }},
};

// N-2-7: the limits between keys.
TEST(ConfigLimits, EveryLimitBetweenKeys) {
  for (const Between& limit : kBetween) {
    cmodel::Config config = named_config("base");
    limit.violate(config);
    expect_violation(config, limit.key, limit.expected, limit.got);
  }
  std::printf("[figure] limits between keys broken and refused = %zu\n", std::size(kBetween));
}

// N-2-7: values that just keep a limit are accepted.
TEST(ConfigLimits, EdgesAreTaken) {
  cmodel::Config config = named_config("base");
  ties_to_even_pixels(config);
  EXPECT_FALSE(cmodel::first_violation(config));
  config = named_config("base");
  config.freeze_below = 65536;
  EXPECT_FALSE(cmodel::first_violation(config));
  config.sheet_int_bits = 1;
  config.sheet_frac_bits = 31;
  EXPECT_FALSE(cmodel::first_violation(config));
  config.pixel_int_bits = 1;
  config.pixel_frac_bits = 31;
  EXPECT_FALSE(cmodel::first_violation(config));
  config.position_int_bits = 9;  // 256 = 128 + 128
  EXPECT_FALSE(cmodel::first_violation(config));
  config.index_kind = static_cast<int>(cmodel::IndexKind::Blit2d);
  config.phases = 32;  // 4096^2 = 2^24 words
  EXPECT_FALSE(cmodel::first_violation(config));
  config.index_kind = static_cast<int>(cmodel::IndexKind::Squared);
  config.position_frac_bits = 10;
  EXPECT_FALSE(cmodel::first_violation(config));
  config.index_kind = static_cast<int>(cmodel::IndexKind::Linear);
  config.position_frac_bits = 12;
  config.rlut_guard_bits = 12;
  EXPECT_FALSE(cmodel::first_violation(config));
  config = named_config("base");
  with_ellipses(config);
  config.position_int_bits = 13;
  config.position_frac_bits = 9;
  EXPECT_FALSE(cmodel::first_violation(config));
  config.rlut_columns = 256;  // 32 windows of 8
  EXPECT_FALSE(cmodel::first_violation(config));
  config.lanes = 16;
  config.rlut_columns = 496;
  config.rlut_guard_bits = 12;
  config.ellipse_frac_bits = 20;  // 10 + 12 + 20 + 8 + 10 = 60
  EXPECT_FALSE(cmodel::first_violation(config));
  config = named_config("base");
  with_ellipses(config);
  config.position_frac_bits = 0;
  config.phases = 1;
  config.rlut_guard_bits = 7;  // 10 + 7 + 4 = 21
  EXPECT_FALSE(cmodel::first_violation(config));
}

TEST(ConfigSet, EveryKeyTakesItsTextAndGivesItBack) {
  int compared = 0;
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    const std::vector<std::string> texts = key.names.empty()
                                               ? std::vector{std::to_string(key.min), std::to_string(key.max)}
                                               : std::vector<std::string>{key.names.begin(), key.names.end()};
    for (const std::string& text : texts) {
      cmodel::Config config = named_config("base"), expected = config;
      const auto wrong = cmodel::set(config, key.name, text);
      ASSERT_FALSE(wrong) << one_line(*wrong);
      EXPECT_EQ(cmodel::text_of(config, key), text) << key.name;
      expected.*key.member = config.*key.member;
      EXPECT_EQ(config, expected) << key.name << " sets another key";
      ++compared;
    }
  }
  std::printf("[figure] texts set and read back = %d\n", compared);
  EXPECT_EQ(compared, 23 * 2 + 7 * 3 + 6 + 2 + 8 * 2 + 3);
}

// N-2-2: an unknown key; N-2-7: values out of their limits.
TEST(ConfigSet, MisuseIsReportedAndNothingChanges) {
  struct Wrong {
    const char *key, *value, *expected, *got;
  };
  for (const Wrong& wrong :
       {Wrong{"sheet.frac_bit", "16", "", ""}, Wrong{"sheet.frac_bits", "sixteen", "4..31", "sixteen"},
        Wrong{"sheet.frac_bits", "16 ", "4..31", "16 "}, Wrong{"sheet.frac_bits", "", "4..31", ""},
        Wrong{"sheet.frac_bits", "32", "4..31", "32"}, Wrong{"sheet.frac_bits", "99999999999", "4..31", "99999999999"},
        Wrong{"array.lanes", "12", "a power of two", "12"}, Wrong{"rounding.light", "1", "trn, rnd or rnd_conv", "1"},
        Wrong{"rounding.light", "RND", "trn, rnd or rnd_conv", "RND"}}) {
    cmodel::Config config = named_config("base");
    const auto violation = cmodel::set(config, wrong.key, wrong.value);
    ASSERT_TRUE(violation) << wrong.key << " = " << wrong.value << " is taken";
    EXPECT_EQ(violation->where, wrong.key);
    EXPECT_EQ(violation->expected, wrong.expected) << wrong.key;
    EXPECT_EQ(violation->got, wrong.got) << wrong.key;
    EXPECT_FALSE(violation->fix.empty()) << wrong.key;
    EXPECT_EQ(config, named_config("base")) << wrong.key << " has changed it";
  }
}

TEST(ConfigSet, AMistypedWordIsSuggested) {
  int words = 0;
  for (const auto& key : cmodel::config_keys()) {
    for (const std::string name : key.names) {
      std::string typed = name;
      std::swap(typed[typed.size() - 1], typed[typed.size() - 2]);
      if (typed == name || name.size() < 3) continue;
      cmodel::Config config = named_config("base");
      const auto wrong = cmodel::set(config, key.name, typed);
      ASSERT_TRUE(wrong) << key.name << " = " << typed;
      EXPECT_EQ(wrong->fix, "did you mean '" + name + "'?") << key.name;
      ++words;
    }
  }
  std::printf("[figure] words mistyped = %d (limit > 10)\n", words);
  EXPECT_GT(words, 10);
  cmodel::Config config = named_config("base");
  EXPECT_EQ(cmodel::set(config, "index.kind", "rltu")->fix, "did you mean 'rlut'?");
}

// N-2-3, N-2-5, N-2-6.
TEST(ConfigHash, ANeutralKeyDoesNotEnterItAndAnyOtherValueDoes) {
  const cmodel::Config base = named_config("base");
  EXPECT_EQ(cmodel::config_hash(base), oracle::hash(symbols_of(base)));
  int neutral = 0;
  std::set<std::uint64_t> hashes{cmodel::config_hash(base)};
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    if (!key.neutral) continue;
    EXPECT_EQ(base.*key.member, *key.neutral) << key.name << ": absent is neutral";
    ++neutral;
    for (int value = key.min; value <= key.max; ++value) {
      cmodel::Config config = base;
      config.*key.member = value;
      EXPECT_EQ(hashes.insert(cmodel::config_hash(config)).second, value != *key.neutral) << key.name << " = " << value;
      EXPECT_EQ(cmodel::config_hash(config), oracle::hash(symbols_of(config))) << key.name;
    }
  }
  std::printf("[figure] neutral keys = %d, hashes = %zu\n", neutral, hashes.size());
  EXPECT_EQ(neutral, 18);
  EXPECT_EQ(hashes.size(), 41U + 1024U + 48U + 1U + 2U + 1U + 12U + 7U + 4U);
}

}  // namespace
}  // namespace fastsplat::test
