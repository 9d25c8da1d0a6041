// SPDX-License-Identifier: Apache-2.0
// A configuration written as TOML reads back unchanged.
#include "driver/config/config_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace fastsplat::driver {
namespace {

class ConfigFile : public ::testing::Test {
 protected:
  cmodel::Config read_back(const cmodel::Config& config) const {
    std::ofstream(path_, std::ios::binary) << to_toml(config);
    return load_config(path_.string());
  }
  void TearDown() override { std::filesystem::remove(path_); }

  /// A name of this process: tests run in parallel.
  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) /
                                ("fastsplat_config_file_test-" + std::to_string(::getpid()) + ".toml");
};

TEST_F(ConfigFile, every_named_configuration_is_read_back) {
  int read = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    EXPECT_EQ(read_back(config), config) << name;
    ++read;
  }
  std::printf("[figure] configurations read back = %d (limit > 0)\n", read);
  EXPECT_GT(read, 0);
}

// An optional key is written if it is not neutral; it then changes the hash.
TEST_F(ConfigFile, keys_off_their_neutral_value_are_read_back) {
  int read = 0;
  for (const auto& key : cmodel::config_keys()) {
    if (!key.neutral) continue;
    for (int value = key.min; value <= key.max; ++value) {
      auto config = load_config("base");
      config.*key.member = value;
      if (cmodel::first_violation(config)) {  // footprints too large for base's count
        config.index_kind = static_cast<int>(cmodel::IndexKind::Blit2d);
        config.phases = 32;
      }
      if (cmodel::first_violation(config)) continue;  // lanes that do not divide a block
      EXPECT_EQ(read_back(config), config) << key.name << " = " << value;
      auto neutral = config;
      neutral.*key.member = *key.neutral;
      EXPECT_EQ(cmodel::config_hash(config) == cmodel::config_hash(neutral), value == *key.neutral);
      ++read;
    }
  }
  std::printf("[figure] keys that may be absent, values read back = %d (limit > 0)\n", read);
  EXPECT_GT(read, 0);
}

TEST_F(ConfigFile, texts_of_any_kind_are_read_back) {
  auto config = load_config("tiny");
  config.name = "a \"name\" with \\ and = #";
  config.description = "# no comment = \"x\"\n[table] \t and \x01";
  config.verified = "";
  EXPECT_EQ(read_back(config), config);
}

// A name is printed in lines of text: names that would break or blank a line are refused when they are written.
TEST_F(ConfigFile, names_that_split_a_line_are_refused) {
  auto config = load_config("tiny");
  int refused = 0;
  for (const std::string name : {"", "   ", "two\nlines", "a\ttab", "\x01", "back\r", "gone\x7f"}) {
    config.name = name;
    try {
      read_back(config);
      ADD_FAILURE() << "'" << name << "' was taken";
    } catch (const UserError& error) {
      ++refused;
      const std::string said = error.what();
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_NE(said.find(":2:8: invalid name"), std::string::npos) << said;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
  }
  std::printf("[figure] names refused = %d of 7\n", refused);
  EXPECT_EQ(refused, 7);
}

}  // namespace
}  // namespace fastsplat::driver
