// SPDX-License-Identifier: Apache-2.0
// The RTL under a second, four-state simulator: every pixel, counter and cycle is the model's. No deciding signal is
// unknown, from power-up on and after a reset of any length in any record.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <random>

#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/icarus/icarus_helper.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Beat;
using testbench::Pattern;

/// The expected output and counts of the device, by the model.
struct Expected {
  struct Row {
    bool last = false;
    std::vector<std::uint32_t> words;  ///< of the pixels inside the tile, 4 each
  };
  std::vector<Row> rows;  ///< of pixels, by beat
  cmodel::Counters counters;
  cmodel::CullLog culls;  ///< groups that the device hides, input of the cycle model
};

class Rows final : public cmodel::PixelSink {
 public:
  Rows(int lanes, std::vector<Expected::Row>& rows) : lanes_(lanes), rows_(rows) {}
  void on_tile(cmodel::TilePixels&& tile) override {
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; x += lanes_) {
        const auto at = [&](int column) { return tile.words.begin() + 4 * (std::ptrdiff_t{y} * tile.width + column); };
        rows_.push_back(
            {y + 1 == tile.height && x + lanes_ >= tile.width, {at(x), at(std::min(x + lanes_, tile.width))}});
      }
    }
  }

 private:
  int lanes_;
  std::vector<Expected::Row>& rows_;
};

Expected expected_of(const cmodel::Config& config, const std::vector<Beat>& beats) {
  Expected expected;
  Rows rows(config.lanes, expected.rows);
  cmodel::Model model(config, cmodel::StreamScope::Subset, rows);
  model.log_culls(&expected.culls);
  model.consume(beats);
  model.finish();
  expected.counters = model.counters();
  return expected;
}

/// The words of a beat's kept pixels (M-port-5); empty if one of them is unknown, or if the kept pixels are not a row
/// from its left (M-port-6).
std::vector<std::uint32_t> kept_words(const PixelBeat& beat) {
  std::vector<std::uint32_t> words;
  for (std::size_t lane = 0; lane < beat.keep.size(); ++lane) {
    if (beat.keep[beat.keep.size() - 1 - lane] != '1') continue;
    if (words.size() != 4 * lane) return {};
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const std::string text = beat.data.substr(beat.data.size() - 8 * (4 * lane + channel + 1), 8);
      if (text.find_first_not_of("0123456789abcdef") != std::string::npos) return {};
      words.push_back(static_cast<std::uint32_t>(std::stoul(text, nullptr, 16)));
    }
  }
  return words;
}

struct Comparison {
  std::uint64_t pixels = 0, counters = 0, differences = 0;
  std::string first;
  void differ(const std::string& what) {
    if (differences++ == 0) first = what;
  }
};

/// All plays against the model: plays to rest as a whole, the others up to their cut.
Comparison compare(const cmodel::Config& config, const Played& played, const Transcript& transcript) {
  Comparison out;
  const Expected expected = expected_of(config, played.beats);
  for (const auto& [number, result] : transcript.plays) {
    const Play& play = played.plays.at(static_cast<std::size_t>(number));
    const std::string where = "play " + std::to_string(number);
    const bool whole = play.linger < 0;
    if (whole ? result.pixels.size() != expected.rows.size() : result.pixels.size() > expected.rows.size())
      out.differ(where + ": " + std::to_string(result.pixels.size()) + " beats of pixels");
    for (std::size_t i = 0; i < std::min(result.pixels.size(), expected.rows.size()); ++i) {
      const auto& row = expected.rows[i];
      out.pixels += row.words.size() / 4;
      if (kept_words(result.pixels[i]) != row.words || result.pixels[i].last != (row.last ? "1" : "0"))
        out.differ(where + ": beat " + std::to_string(i) + " of pixels is " + result.pixels[i].keep + " " +
                   result.pixels[i].data);
    }
    if (!whole) continue;
    cmodel::CycleModel cycles(config, cmodel::StreamScope::Subset,
                              {.input = &played.patterns.at(play.input),
                               .output = &played.patterns.at(play.ready),
                               .sliced = true,
                               .culls = &expected.culls});
    cycles.consume(played.beats);
    cycles.finish();
    std::vector<std::uint64_t> words;
    expected.counters.for_each([&](const char*, std::uint64_t value, const char*) { words.push_back(value); });
    cycles.stalls().for_each(config, [&](const char*, std::uint64_t value, const char*) { words.push_back(value); });
    if (result.counters.size() != words.size()) out.differ(where + ": not all counters were read");
    for (std::size_t n = 0; n < std::min(words.size(), result.counters.size()); ++n, ++out.counters) {
      if (result.counters[n] != words[n])
        out.differ(where + ": counter " + std::to_string(n) + " is " + std::to_string(result.counters[n]) + ", not " +
                   std::to_string(words[n]));
    }
  }
  return out;
}

std::vector<Pattern> patterns(std::uint64_t seed) {
  std::vector<Pattern> all;
  for (const auto& text : Pattern::examples()) all.emplace_back(text, seed++);
  return all;
}

void judge(const std::string& what, const cmodel::Config& config, const Played& played, const Transcript& transcript) {
  const Comparison comparison = compare(config, played, transcript);
  EXPECT_TRUE(transcript.ended) << what << ": " << transcript.plays.size() << " of " << played.plays.size() << " plays";
  EXPECT_TRUE(transcript.wrong.empty()) << what << ": " << transcript.wrong.size()
                                        << ", first: " << transcript.wrong.front();
  EXPECT_EQ(comparison.differences, 0U) << what << ": " << comparison.first;
  EXPECT_GT(comparison.pixels, 0U);
  EXPECT_GT(comparison.counters, 0U);
  std::uint64_t cycles = 0;
  for (const auto& [number, result] : transcript.plays) cycles += result.cycles;
  // Also into the report of --gtest_output, which docs/evidence.md is made from.
  const auto keep = [&](const char* name, std::uint64_t value) {
    ::testing::Test::RecordProperty(what.substr(what.find(' ') + 1) + "_" + name, std::to_string(value));
  };
  keep("plays", played.plays.size());
  keep("cycles", cycles);
  keep("pixels", comparison.pixels);
  keep("counters", comparison.counters);
  keep("different", comparison.differences);
  keep("unknown", transcript.wrong.size());
  std::printf(
      "[figure] %s: plays = %zu, cycles = %llu, pixels = %llu, counters = %llu, different = %llu (limit 0), "
      "unknown = %zu (limit 0)\n",
      what.c_str(), played.plays.size(), static_cast<unsigned long long>(cycles),
      static_cast<unsigned long long>(comparison.pixels), static_cast<unsigned long long>(comparison.counters),
      static_cast<unsigned long long>(comparison.differences), transcript.wrong.size());
}

/// Only the radius set with the fewest words, for all splats: Icarus needs a millisecond for a cycle of `small`, and a
/// table word takes one.
void keep_smallest_set(testbench::StreamDocument& document) {
  const cmodel::LoadTable* least = nullptr;
  for (const auto& table : document.tables) {
    if (table.table != cmodel::Table::Rlut) continue;
    if (least == nullptr || table.words.size() < least->words.size()) least = &table;
  }
  const cmodel::LoadTable kept = *least;
  std::erase_if(document.tables, [](const auto& table) { return table.table == cmodel::Table::Rlut; });
  document.tables.push_back(kept);
  for (auto& tile : document.tiles)
    for (auto& sheet : tile.sheets)
      for (auto& record : sheet.records)
        if (auto* splat = std::get_if<cmodel::SplatRecord>(&record)) splat->set = kept.radius.set;
}

/// Two small tiles with all kinds of records, and a minimum of tables: the stream that resets cut.
std::vector<Beat> every_kind(const cmodel::Config& config) {
  testbench::StreamDocument document;
  for (std::uint64_t seed = 5; document.tiles.size() < 2 || document.tiles.front().sheets.empty(); ++seed)
    document = testbench::make_stimulus(config, testbench::StimulusClass::Mixed, seed, 30).document;
  keep_smallest_set(document);
  document.tiles.resize(2);
  for (auto& tile : document.tiles) {
    tile.begin.width = 7;
    tile.begin.height = 5;
    for (auto& sheet : tile.sheets) sheet.records.resize(std::min<std::size_t>(sheet.records.size(), 6));
  }
  document.tiles.front().sheets.front().records.emplace_back(cmodel::CullBlock{.tag = 0, .width = 3, .height = 3});
  return testbench::write_document(config, testbench::arranged(document));
}

/// The beats of each kind of record; a table's words are a kind of their own.
std::map<std::string, std::vector<std::size_t>> kinds_of(const std::vector<Beat>& beats) {
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < beats.size(); ++i) {
    kinds[cmodel::find_layout(static_cast<std::uint8_t>(beats[i][0]))->name].push_back(i);
    if (static_cast<cmodel::Opcode>(beats[i][0] & 0xff) != cmodel::Opcode::LoadTable) continue;
    for (std::uint64_t left = cmodel::announced_beats(beats[i]); left > 0; --left) kinds["table words"].push_back(++i);
  }
  return kinds;
}

/// A scene in several tiles, the last of them smaller, once without pauses and once with.
Played scene_of(const cmodel::Config& config, scene::SceneDescription description = {}) {
  description.volume = "shells:8";
  description.width = 40;  // more than a tile, and no multiple of one
  description.height = 24;
  Played played{.beats = scene_beats(description, config), .patterns = patterns(7), .plays = {}};
  for (std::size_t i = 0; i < 2; ++i)
    played.plays.push_back({.beats = played.beats.size(), .input = i * 3, .ready = i * 3});
  return played;
}

class SecondSimulator : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (const std::string missing = Icarus::missing(); !missing.empty()) GTEST_SKIP() << missing;
  }
  cmodel::Config config() const { return driver::load_config(GetParam()); }
};

TEST_P(SecondSimulator, StreamsEqualTheModelUnderEveryPattern) {
  const Icarus icarus(config(), std::string("streams-") + GetParam());
  std::printf("[figure] %s\n", Icarus::version().c_str());
  Played played = scene_of(config());
  Transcript transcript = icarus.play(played);
  // Four-state from the first moment: all is unknown before the first reset.
  EXPECT_EQ(transcript.power_up, "s_tready=x m_tvalid=x bvalid=x rvalid=x error=x");
  judge(std::string(GetParam()) + " scene", config(), played, transcript);

  auto document = testbench::make_stimulus(config(), testbench::StimulusClass::Mixed, 11, 60).document;
  keep_smallest_set(document);
  played.beats = testbench::write_document(config(), document);
  played.plays.clear();
  for (std::size_t i = 0; i < played.patterns.size(); ++i)
    played.plays.push_back({.beats = played.beats.size(), .input = played.patterns.size() - 1 - i, .ready = i});
  judge(std::string(GetParam()) + " random", config(), played, icarus.play(played));
}

TEST_P(SecondSimulator, ResetsOfAnyLengthInAnyRecordLeaveNothingBehind) {
  const Icarus icarus(config(), std::string("resets-") + GetParam());
  Played played{.beats = every_kind(config()), .patterns = patterns(3), .plays = {}};
  const auto kinds = kinds_of(played.beats);
  EXPECT_EQ(kinds.size(), 10U) << "a kind of record is not in the stream";
  // Each kind is cut off by a reset of 1 cycle and by longer ones; on `tiny` every length is met.
  const bool all = config().lanes == 2;
  std::mt19937 random(1);
  std::map<int, int> lengths;
  const auto cut = [&](const std::vector<std::size_t>& beats, int reset) {
    const std::size_t beat = beats[random() % beats.size()];
    const auto pattern = [&] { return random() % played.patterns.size(); };
    // In the register still, or up to its windows, blocks and pixels.
    const int linger = random() % 2 == 0 ? 0 : static_cast<int>(random() % 30);
    played.plays.push_back({.reset = 4, .beats = beat + 1, .linger = linger, .input = pattern(), .ready = pattern()});
    played.plays.push_back({.reset = reset, .beats = played.beats.size(), .input = pattern(), .ready = pattern()});
    ++lengths[reset];
  };
  int length = 1;
  for (const auto& [name, beats] : kinds) {
    cut(beats, 1);
    for (int i = 0; i < (all ? 2 : 1); ++i, ++length) cut(beats, 1 + (all ? length : 2 * length - 1) % 20);
  }
  EXPECT_EQ(lengths.size(), all ? 20U : 11U);
  judge(std::string(GetParam()) + " resets", config(), played, icarus.play(played));
}

INSTANTIATE_TEST_SUITE_P(Configurations, SecondSimulator, ::testing::Values("tiny", "small"),
                         [](const auto& param) { return std::string(param.param); });

/// Features that only some devices have. AsWritten where Icarus 11 can (icarus_helper.hpp).
struct Variant {
  const char* name;
  const char* config;
  scene::Method method = scene::Method::ImageAligned;
  scene::ClassifyOrder classify = scene::ClassifyOrder::Pre;
  Combinational combinational = Combinational::AsWritten;
};
void PrintTo(const Variant& variant, std::ostream* out) { *out << variant.name; }

class SecondSimulatorOfVariants : public ::testing::TestWithParam<Variant> {};

TEST_P(SecondSimulatorOfVariants, StreamsEqualTheModel) {
  if (const std::string missing = Icarus::missing(); !missing.empty()) GTEST_SKIP() << missing;
  const auto [name, file, method, classify, combinational] = GetParam();
  const cmodel::Config config = driver::load_config(file);
  const Icarus icarus(config, std::string("variant-") + name, {}, combinational);
  scene::SceneDescription description;
  description.method = method;
  description.classify = classify;
  Played played = scene_of(config, description);
  const Expected expected = expected_of(config, played.beats);
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Subset, {.sliced = true, .culls = &expected.culls});
  cycles.consume(played.beats);
  cycles.finish();
  const std::uint64_t hidden = cycles.stalls().hidden_splats + cycles.stalls().hidden_windows;
  std::printf("[figure] %s: hidden splats and windows = %llu\n", name, static_cast<unsigned long long>(hidden));
  EXPECT_EQ(hidden > 0, config.culls());
  judge(std::string(name) + " scene", config, played, icarus.play(played));

  auto document = testbench::make_stimulus(config, testbench::StimulusClass::Mixed, 11, 200).document;
  keep_smallest_set(document);
  played.beats = testbench::write_document(config, document);
  played.plays.clear();
  for (std::size_t i = 0; i < played.patterns.size(); ++i)
    played.plays.push_back({.beats = played.beats.size(), .input = played.patterns.size() - 1 - i, .ready = i});
  judge(std::string(name) + " random", config, played, icarus.play(played));
}

INSTANTIATE_TEST_SUITE_P(
    Configurations, SecondSimulatorOfVariants,
    ::testing::Values(Variant{"sheets", "westover"},
                      Variant{.name = "samples",
                              .config = "westover",
                              .method = scene::Method::Westover,
                              .combinational = Combinational::AlwaysStar},
                      Variant{.name = "cull", .config = "cull", .combinational = Combinational::AlwaysStar},
                      Variant{.name = "densities",
                              .config = "post",
                              .classify = scene::ClassifyOrder::Post,
                              .combinational = Combinational::AlwaysStar}),
    [](const auto& param) { return std::string(param.param.name); });

struct Planted {
  const char* name;
  const char* from;
  const char* to;
};
void PrintTo(const Planted& planted, std::ostream* out) { *out << planted.name; }

/// Registers and memories that are read before they are written: two-valued simulation starts them with some number and
/// may never show a difference.
class UsedBeforeSet : public ::testing::TestWithParam<Planted> {};

TEST_P(UsedBeforeSet, IsSeenAsUnknown) {
  if (const std::string missing = Icarus::missing(); !missing.empty()) GTEST_SKIP() << missing;
  const auto config = driver::load_config("tiny");
  const Icarus icarus(config, std::string("planted-") + GetParam().name, {{GetParam().from, GetParam().to}});
  Played played{.beats = every_kind(config), .patterns = {Pattern()}, .plays = {}};
  played.plays.push_back({.beats = played.beats.size()});
  const Transcript transcript = icarus.play(played);
  const Comparison comparison = compare(config, played, transcript);
  ASSERT_FALSE(transcript.wrong.empty()) << "SURVIVED: " << GetParam().from;
  RecordProperty("unknown_or_stray", std::to_string(transcript.wrong.size()));
  std::printf("[figure] planted %s: unknown or stray = %zu, different = %llu; first: %s\n", GetParam().name,
              transcript.wrong.size(), static_cast<unsigned long long>(comparison.differences),
              transcript.wrong.front().c_str());
}

INSTANTIATE_TEST_SUITE_P(
    Planted, UsedBeforeSet,
    ::testing::Values(Planted{"windows_not_reset", "column_q <= '0;\n        row_q <= '0;", ""},
                      Planted{"sheets_not_wiped",
                              "assign we = (wipe_i && !`FASTSPLAT_FAULT(MISSED_WIPE)) || clear || mine;",
                              "assign we = clear || mine;"},
                      Planted{"picture_not_wiped", ".we_i(wipe_i || (sent_q", ".we_i((sent_q"},
                      Planted{"counter_not_reset", "if (!rst_ni || clear_o) counter_q[n] <= '0;",
                              "if (clear_o) counter_q[n] <= '0;"}),
    [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace fastsplat::test
