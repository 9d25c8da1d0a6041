// SPDX-License-Identifier: Apache-2.0
// Misuse of the C interface returns a status and a one-line error, and has no other effect: NULL, invalid handles,
// wrong sizes, calls out of order, invalid streams.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "testbench/capi/fastsplat_dpi.h"
#include "tests/capi/truth_helper.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {
namespace {

class CapiMisuse : public ::testing::Test {
 protected:
  /// `call` returns `status`, and the error is one line that holds `words`.
  void refused(fastsplat_status got, const std::string& words, fastsplat_status status = FASTSPLAT_USAGE) {
    ++refusals_;
    EXPECT_EQ(got, status) << words;
    const std::string error = fastsplat_last_error();
    EXPECT_NE(error.find(words), std::string::npos) << "got: " << error << "\nwanted: " << words;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  void TearDown() override {
    std::printf("[figure] refusals = %d (limit > 0)\n", refusals_);
    EXPECT_GT(refusals_, 0);
  }
  const Config config_{"tiny"};
  const Truth& truth_ = truth_of("tiny");

 private:
  int refusals_ = 0;
};

TEST_F(CapiMisuse, NullIsRefusedEverywhere) {
  fastsplat_config* config = nullptr;
  fastsplat_model* model = nullptr;
  fastsplat_checker* checker = nullptr;
  fastsplat_pattern* pattern = nullptr;
  const Model live(config_);
  const Checker check(config_);
  fastsplat_tap tap{};
  tap.struct_size = sizeof tap;
  fastsplat_tile tile{};
  tile.struct_size = sizeof tile;
  fastsplat_report report{};
  report.struct_size = sizeof report;
  fastsplat_shown shown{};
  shown.struct_size = sizeof shown;
  std::uint64_t number = 0;
  std::int64_t value = 0;
  std::int32_t flag = 0;
  std::size_t size = 0;
  const char* kNull = "is NULL";
  refused(fastsplat_config_named(nullptr, &config), kNull);
  refused(fastsplat_config_named("tiny", nullptr), kNull);
  refused(fastsplat_config_text(nullptr, 0, "x", &config), kNull);
  refused(fastsplat_config_text("", 0, "x", nullptr), kNull);
  refused(fastsplat_config_file(nullptr, &config), kNull);
  refused(fastsplat_config_file("x", nullptr), kNull);
  refused(fastsplat_config_name(0, nullptr), kNull);
  refused(fastsplat_config_hash(nullptr, &number), kNull);
  refused(fastsplat_config_hash(config_.handle, nullptr), kNull);
  refused(fastsplat_config_value(nullptr, "array.lanes", &value), kNull);
  refused(fastsplat_config_value(config_.handle, nullptr, &value), kNull);
  refused(fastsplat_config_value(config_.handle, "array.lanes", nullptr), kNull);
  refused(fastsplat_model_create(nullptr, 0, 0, &model), kNull);
  refused(fastsplat_model_create(config_.handle, 0, 0, nullptr), kNull);
  refused(fastsplat_model_feed(nullptr, words_of(truth_.beats), 1), kNull);
  refused(fastsplat_model_feed(live.handle, nullptr, 1), kNull);
  refused(fastsplat_model_finish(nullptr), kNull);
  refused(fastsplat_model_reset(nullptr), kNull);
  refused(fastsplat_model_next_tap(nullptr, &tap), kNull);
  refused(fastsplat_model_next_tap(live.handle, nullptr), kNull);
  refused(fastsplat_model_next_tile(nullptr, &tile), kNull);
  refused(fastsplat_model_next_tile(live.handle, nullptr), kNull);
  refused(fastsplat_model_counters(nullptr, &number, 16), kNull);
  refused(fastsplat_model_counters(live.handle, nullptr, 16), kNull);
  refused(fastsplat_counter_name(0, nullptr), kNull);
  refused(fastsplat_pattern_create(nullptr, 0, &pattern), kNull);
  refused(fastsplat_pattern_create("always", 0, nullptr), kNull);
  refused(fastsplat_pattern_at(nullptr, 0, &flag), kNull);
  refused(fastsplat_checker_create(nullptr, nullptr, &checker), kNull);
  refused(fastsplat_checker_create(config_.handle, nullptr, nullptr), kNull);
  refused(fastsplat_checker_reset(nullptr), kNull);
  refused(fastsplat_checker_start(nullptr, 0), kNull);
  refused(fastsplat_checker_took(nullptr, words_of(truth_.beats), 1), kNull);
  refused(fastsplat_checker_took(check.handle, nullptr, 1), kNull);
  refused(fastsplat_checker_port_words(nullptr, 0, &size), kNull);
  refused(fastsplat_checker_port_words(check.handle, 0, nullptr), kNull);
  refused(fastsplat_checker_showed(nullptr, &shown), kNull);
  refused(fastsplat_checker_showed(check.handle, nullptr), kNull);
  refused(fastsplat_checker_stopped(nullptr, &flag), kNull);
  refused(fastsplat_checker_stopped(check.handle, nullptr), kNull);
  refused(fastsplat_checker_finish(nullptr, nullptr, 0), kNull);
  refused(fastsplat_checker_finish(check.handle, nullptr, 16), kNull);
  refused(fastsplat_checker_report(nullptr, &report), kNull);
  refused(fastsplat_checker_report(check.handle, nullptr), kNull);
  EXPECT_STREQ(fastsplat_checker_first_mismatch(nullptr), "");
  EXPECT_STREQ(fastsplat_checker_summary(nullptr), "");
  EXPECT_EQ(fastsplat_dpi_checker(nullptr, 0, "always", "always", 0), nullptr);
  EXPECT_EQ(fastsplat_dpi_checker("tiny", 0, "always", "always", 0), nullptr);
  refused(FASTSPLAT_INPUT, "built for another configuration", FASTSPLAT_INPUT);
  refused(fastsplat_dpi_took(nullptr, words_of(truth_.beats)), kNull);
  refused(fastsplat_dpi_finish(nullptr, nullptr, 42), kNull);
  refused(fastsplat_dpi_sheet_done(nullptr, 0), kNull);
  EXPECT_EQ(config, nullptr);
  EXPECT_EQ(model, nullptr);
  EXPECT_EQ(checker, nullptr);
  EXPECT_EQ(fastsplat_config_destroy(nullptr), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_model_destroy(nullptr), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_pattern_destroy(nullptr), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_checker_destroy(nullptr), FASTSPLAT_OK);
}

TEST_F(CapiMisuse, InvalidHandlesAreRefused) {
  fastsplat_model* model = nullptr;
  ASSERT_EQ(fastsplat_model_create(config_.handle, FASTSPLAT_WHOLE, 0, &model), FASTSPLAT_OK);
  refused(fastsplat_config_destroy(reinterpret_cast<fastsplat_config*>(model)), "expected configuration, got model");
  refused(fastsplat_checker_finish(reinterpret_cast<fastsplat_checker*>(model), nullptr, 0),
          "expected checker, got model");
  ASSERT_EQ(fastsplat_model_destroy(model), FASTSPLAT_OK);
  refused(fastsplat_model_destroy(model), "invalid handle");
  refused(fastsplat_model_feed(model, words_of(truth_.beats), 1), "invalid handle");
  int local = 0;
  refused(fastsplat_model_reset(reinterpret_cast<fastsplat_model*>(&local)), "invalid handle");
}

TEST_F(CapiMisuse, WrongSizesAndNumbersAreRefused) {
  const Model model(config_);
  const Checker checker(config_);
  fastsplat_model* out = nullptr;
  fastsplat_checker* checked = nullptr;
  fastsplat_tap tap{};
  tap.struct_size = sizeof tap - 1;
  refused(fastsplat_model_next_tap(model.handle, &tap), "struct_size");
  fastsplat_tile tile{};
  refused(fastsplat_model_next_tile(model.handle, &tile), "struct_size");
  fastsplat_report report{};
  refused(fastsplat_checker_report(checker.handle, &report), "struct_size");
  fastsplat_checker_options options{};
  refused(fastsplat_checker_create(config_.handle, &options, &checked), "struct_size");
  options.struct_size = sizeof options;
  options.scope = 7;
  refused(fastsplat_checker_create(config_.handle, &options, &checked), "unknown scope");
  options.scope = FASTSPLAT_WHOLE;
  options.output_pattern = "sometimes";
  refused(fastsplat_checker_create(config_.handle, &options, &checked), "unknown ready/valid pattern");
  refused(fastsplat_model_create(config_.handle, 2, 0, &out), "unknown scope");
  refused(fastsplat_model_create(config_.handle, 0, 32, &out), "unknown taps");
  std::uint64_t counters[FASTSPLAT_COUNTERS_ALL] = {};
  refused(fastsplat_model_counters(model.handle, counters, 15), "expected 16, got 15");
  refused(fastsplat_checker_finish(checker.handle, counters, 17), "expected 0, 16 or 21, got 17");
  std::int64_t value = 0;
  refused(fastsplat_config_value(config_.handle, "array.lines", &value), "unknown key 'array.lines'");
  std::size_t words = 0;
  refused(fastsplat_checker_port_words(checker.handle, FASTSPLAT_PORTS, &words),
          "unknown port (expected at most 6, got 7)");

  std::vector<std::uint32_t> ones(1000, ~0U);
  fastsplat_shown shown{};
  shown.struct_size = sizeof shown;
  shown.words = ones.data();
  shown.cycle = 10;
  for (shown.port = 0; shown.port < FASTSPLAT_PORTS; ++shown.port) {
    ASSERT_EQ(fastsplat_checker_port_words(checker.handle, shown.port, &words), FASTSPLAT_OK);
    shown.word_count = words + 1;
    refused(fastsplat_checker_showed(checker.handle, &shown), "wrong number of words");
    if (words == 0) continue;
    shown.word_count = words - 1;
    refused(fastsplat_checker_showed(checker.handle, &shown), "wrong number of words");
    shown.word_count = words;
    shown.words = nullptr;
    refused(fastsplat_checker_showed(checker.handle, &shown), "words is NULL");
    shown.words = ones.data();
  }
  shown.port = FASTSPLAT_PORT_COMPOSITE;
  ASSERT_EQ(fastsplat_checker_port_words(checker.handle, shown.port, &shown.word_count), FASTSPLAT_OK);
  shown.block = 256;  // of tiny 0..255
  refused(fastsplat_checker_showed(checker.handle, &shown), "block number out of range");
  shown.block = 255;
  EXPECT_EQ(fastsplat_checker_showed(checker.handle, &shown), FASTSPLAT_OK);
  shown.cycle = 9;
  refused(fastsplat_checker_showed(checker.handle, &shown), "cycles must not decrease");
  shown.struct_size = 8;
  refused(fastsplat_checker_showed(checker.handle, &shown), "struct_size");
}

TEST_F(CapiMisuse, CallsOutOfOrderAreRefused) {
  const Model model(config_);
  // An incomplete stream still ends.
  refused(fastsplat_model_finish(model.handle), "stream", FASTSPLAT_INPUT);
  refused(fastsplat_model_feed(model.handle, words_of(truth_.beats), 1), "the stream failed earlier");
  refused(fastsplat_model_finish(model.handle), "the stream failed earlier");
  ASSERT_EQ(fastsplat_model_reset(model.handle), FASTSPLAT_OK);
  ASSERT_EQ(fastsplat_model_feed(model.handle, words_of(truth_.beats), truth_.beats.size()), FASTSPLAT_OK);
  ASSERT_EQ(fastsplat_model_finish(model.handle), FASTSPLAT_OK) << fastsplat_last_error();
  refused(fastsplat_model_finish(model.handle), "already finished");
  refused(fastsplat_model_feed(model.handle, words_of(truth_.beats), 1), "finished");

  const Checker checker(config_);
  ASSERT_EQ(fastsplat_checker_start(checker.handle, kFirstBeat), FASTSPLAT_OK);
  refused(fastsplat_checker_start(checker.handle, kFirstBeat), "already started");
  ASSERT_EQ(report_all(truth_.events, checker.handle), FASTSPLAT_OK);
  refused(fastsplat_checker_finish(checker.handle, truth_.counters.data(), FASTSPLAT_MODEL_COUNTERS),
          "counters of cycles are missing");
  ASSERT_EQ(fastsplat_checker_finish(checker.handle, truth_.counters.data(), truth_.counters.size()), FASTSPLAT_OK);
  refused(fastsplat_checker_finish(checker.handle, nullptr, 0), "finished");
  refused(fastsplat_checker_took(checker.handle, words_of(truth_.beats), 1), "finished");
  ASSERT_EQ(fastsplat_checker_reset(checker.handle), FASTSPLAT_OK);
  ASSERT_EQ(fastsplat_checker_took(checker.handle, words_of(truth_.beats), 1), FASTSPLAT_OK);
  refused(fastsplat_checker_start(checker.handle, 0), "beats were already accepted");
  refused(fastsplat_checker_finish(checker.handle, nullptr, 0), "stream", FASTSPLAT_INPUT);
  refused(fastsplat_checker_took(checker.handle, words_of(truth_.beats), 1), "the stream failed earlier");
  refused(fastsplat_checker_finish(checker.handle, nullptr, 0), "the stream failed earlier");
}

TEST_F(CapiMisuse, AStreamThatBreaksIsRefusedAtItsBeatAndThenAltogether) {
  const Model model(config_);
  const Checker checker(config_);
  auto beats = truth_.beats;
  beats[1][0] |= 0xff;  // no such opcode
  const std::string where = "beat 1 (byte offset " + std::to_string(4 * FASTSPLAT_BEAT_WORDS) + ")";
  refused(fastsplat_model_feed(model.handle, words_of(beats), beats.size()), where, FASTSPLAT_INPUT);
  refused(fastsplat_model_feed(model.handle, words_of(beats), 1), "the stream failed earlier");
  refused(fastsplat_model_finish(model.handle), "the stream failed earlier");
  refused(fastsplat_checker_took(checker.handle, words_of(beats), 2), where, FASTSPLAT_INPUT);
  refused(fastsplat_checker_took(checker.handle, words_of(beats), 1), "the stream failed earlier");
  refused(fastsplat_checker_finish(checker.handle, nullptr, 0), "the stream failed earlier");
  ASSERT_EQ(fastsplat_model_reset(model.handle), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_model_feed(model.handle, words_of(truth_.beats), truth_.beats.size()), FASTSPLAT_OK);
  // The stream of another configuration.
  const Config other("small");
  const Model foreign(other);
  refused(fastsplat_model_feed(foreign.handle, words_of(truth_.beats), 1), "configuration", FASTSPLAT_INPUT);
}

TEST_F(CapiMisuse, ConfigurationsThatBreakTheirRulesAreRefused) {
  fastsplat_config* out = nullptr;
  refused(fastsplat_config_named("tinny", &out), "no such built-in configuration", FASTSPLAT_INPUT);
  refused(fastsplat_config_named("/etc/passwd", &out), "no such built-in configuration", FASTSPLAT_INPUT);
  refused(fastsplat_config_file("tiny", &out),
          "tiny: no such file (expected a configuration's .toml file); use fastsplat_config_named", FASTSPLAT_INPUT);
  refused(fastsplat_config_file("/", &out), "is a directory", FASTSPLAT_INPUT);
  const std::string text = "lanes = ";
  refused(fastsplat_config_text(text.data(), text.size(), "mine.toml", &out), "mine.toml:1:9", FASTSPLAT_INPUT);
  refused(fastsplat_config_text("", 0, nullptr, &out), "configuration: key", FASTSPLAT_INPUT);
  refused(fastsplat_config_text(text.data(), std::size_t{1} << 21, nullptr, &out), "too long");
  EXPECT_EQ(out, nullptr);
}

/// Any output of a device under test and any stream give a status, never a crash.
TEST_F(CapiMisuse, NonsenseNeverEndsTheProcess) {
  Random random(seed_or(11));
  int accepted = 0, thrown_out = 0, mismatching = 0;
  for (int round = 0; round < 60; ++round) {
    const Checker checker(config_);
    auto beats = truth_.beats;
    for (int flips = 0; flips < 1 + round % 4; ++flips) {
      auto& beat = beats[static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(beats.size()) - 1))];
      beat[static_cast<std::size_t>(random.between(0, 5))] ^= 1U << random.between(0, 31);
    }
    std::vector<std::uint32_t> noise(64);
    fastsplat_shown shown{};
    shown.struct_size = sizeof shown;
    for (const auto& beat : beats) {
      const auto status = fastsplat_checker_took(checker.handle, beat.data(), 1);
      if (status != FASTSPLAT_OK) {
        refused(status, "beat", FASTSPLAT_INPUT);
        ++thrown_out;
        break;
      }
      for (auto& word : noise) word = static_cast<std::uint32_t>(random.next());
      shown.port = static_cast<std::uint32_t>(random.between(0, FASTSPLAT_PORTS - 1));
      ASSERT_EQ(fastsplat_checker_port_words(checker.handle, shown.port, &shown.word_count), FASTSPLAT_OK);
      shown.words = noise.data();
      shown.tag = noise[0];
      shown.x = noise[1];
      shown.y = noise[2];
      shown.mx = noise[3];
      shown.my = noise[4];
      shown.block = noise[5] % 256;
      shown.last = static_cast<std::int32_t>(noise[6] & 1);
      shown.cut = static_cast<std::int32_t>(noise[6] & 2);
      shown.hidden = static_cast<std::int32_t>(noise[6] & 4);
      shown.given = noise[7];
      shown.keep = noise[8];
      shown.tile = noise[9];
      ++shown.cycle;
      ASSERT_EQ(fastsplat_checker_showed(checker.handle, &shown), FASTSPLAT_OK) << fastsplat_last_error();
      ++accepted;
    }
    if (std::string(fastsplat_checker_first_mismatch(checker.handle)) != "") ++mismatching;
    refused(fastsplat_checker_finish(checker.handle, nullptr, 0) == FASTSPLAT_OK ? FASTSPLAT_OK : FASTSPLAT_FAILED, "",
            FASTSPLAT_FAILED);
  }
  std::printf("[figure] nonsense_shown = %d (limit > 100)\n[figure] broken_streams = %d (limit > 10)\n", accepted,
              thrown_out);
  EXPECT_GT(mismatching, 30);
  EXPECT_GT(accepted, 100);
  EXPECT_GT(thrown_out, 10);
}

}  // namespace
}  // namespace fastsplat::test
