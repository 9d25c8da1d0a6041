// SPDX-License-Identifier: Apache-2.0
// The model through the C interface gives the words of the model itself.
#include "cmodel/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/capi/truth_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

/// A record or a tile, flat.
using Words = std::vector<std::uint32_t>;

struct Direct final : cmodel::TapSink, cmodel::PixelSink {
  std::vector<Words> taps, tiles;
  void on_tap(const cmodel::TapRecord& record) override {
    Words words{static_cast<std::uint32_t>(record.tap),
                record.tile,
                record.sheet,
                record.tag,
                static_cast<std::uint32_t>(record.x),
                static_cast<std::uint32_t>(record.y)};
    words.insert(words.end(), record.payload.begin(), record.payload.end());
    taps.push_back(std::move(words));
  }
  void on_tile(cmodel::TilePixels&& tile) override {
    Words words{tile.tile, static_cast<std::uint32_t>(tile.x), static_cast<std::uint32_t>(tile.y),
                static_cast<std::uint32_t>(tile.width), static_cast<std::uint32_t>(tile.height)};
    words.insert(words.end(), tile.words.begin(), tile.words.end());
    tiles.push_back(std::move(words));
  }
};

std::vector<Words> taps_of(fastsplat_model* model) {
  std::vector<Words> out;
  fastsplat_tap tap{};
  tap.struct_size = sizeof tap;
  while (fastsplat_model_next_tap(model, &tap) == FASTSPLAT_OK) {
    Words words{
        tap.tap, tap.tile, tap.sheet, tap.tag, static_cast<std::uint32_t>(tap.x), static_cast<std::uint32_t>(tap.y)};
    words.insert(words.end(), tap.payload, tap.payload + tap.words);
    out.push_back(std::move(words));
  }
  return out;
}

std::vector<Words> tiles_of(fastsplat_model* model) {
  std::vector<Words> out;
  fastsplat_tile tile{};
  tile.struct_size = sizeof tile;
  while (fastsplat_model_next_tile(model, &tile) == FASTSPLAT_OK) {
    Words words{tile.tile, static_cast<std::uint32_t>(tile.x), static_cast<std::uint32_t>(tile.y), tile.width,
                tile.height};
    words.insert(words.end(), tile.rgba, tile.rgba + tile.words);
    out.push_back(std::move(words));
  }
  return out;
}

void append(std::vector<Words>& to, std::vector<Words> more) {
  for (auto& one : more) to.push_back(std::move(one));
}

TEST(CapiModel, GivesTheModelsTapsTilesAndCounters) {
  std::size_t records = 0, tiles = 0;
  for (const char* name : {"tiny", "small", "year2000"}) {
    const Truth& truth = truth_of(name);
    Direct direct;
    cmodel::Model model(truth.config, cmodel::StreamScope::Whole, direct, &direct);
    model.consume(truth.beats);

    const Config config(name);
    const Model handle(config);
    std::vector<Words> shown, finished;
    // In pieces of every size, taken as they come.
    for (std::size_t at = 0, piece = 1; at < truth.beats.size(); at += piece, piece = piece % 7 + 1) {
      piece = std::min(piece, truth.beats.size() - at);
      ASSERT_EQ(fastsplat_model_feed(handle.handle, truth.beats[at].data(), piece), FASTSPLAT_OK)
          << fastsplat_last_error();
      append(shown, taps_of(handle.handle));
      append(finished, tiles_of(handle.handle));
    }
    ASSERT_EQ(fastsplat_model_finish(handle.handle), FASTSPLAT_OK) << fastsplat_last_error();
    EXPECT_EQ(shown, direct.taps) << name;
    EXPECT_EQ(finished, direct.tiles) << name;
    std::uint64_t counters[FASTSPLAT_MODEL_COUNTERS];
    ASSERT_EQ(fastsplat_model_counters(handle.handle, counters, std::size(counters)), FASTSPLAT_OK);
    EXPECT_TRUE(std::equal(std::begin(counters), std::end(counters), truth.counters.begin())) << name;
    records += shown.size();
    tiles += finished.size();
  }
  std::printf("[figure] capi_records = %zu (limit > 1000)\n[figure] capi_tiles = %zu (limit > 0)\n", records, tiles);
  EXPECT_GT(records, 1000u);
  EXPECT_GT(tiles, 0u);
}

TEST(CapiModel, KeepsTheTapsAskedForAndStartsAfreshAfterReset) {
  const Truth& truth = truth_of("tiny");
  const Config config("tiny");
  const Model all(config), some(config, 1U << FASTSPLAT_TAP_SHEET), none(config, 0);
  for (const auto* model : {&all, &some, &none})
    ASSERT_EQ(fastsplat_model_feed(model->handle, words_of(truth.beats), truth.beats.size()), FASTSPLAT_OK);
  auto every = taps_of(all.handle);
  const auto once = every;
  std::erase_if(every, [](const Words& record) { return record[0] != FASTSPLAT_TAP_SHEET; });
  EXPECT_FALSE(every.empty());
  EXPECT_EQ(taps_of(some.handle), every);
  EXPECT_TRUE(taps_of(none.handle).empty());
  const auto pixels = tiles_of(none.handle);
  ASSERT_EQ(fastsplat_model_finish(all.handle), FASTSPLAT_OK);
  ASSERT_EQ(fastsplat_model_reset(all.handle), FASTSPLAT_OK);
  ASSERT_EQ(fastsplat_model_feed(all.handle, words_of(truth.beats), truth.beats.size()), FASTSPLAT_OK);
  EXPECT_EQ(taps_of(all.handle), once);
  EXPECT_EQ(tiles_of(all.handle), pixels);
}

TEST(CapiModel, ConfigurationsByNameTextAndFileAreTheSame) {
  const std::string path = FASTSPLAT_SOURCE_DIR "/configs/tiny.toml";
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string toml = text.str();
  fastsplat_config *from_text = nullptr, *from_file = nullptr;
  ASSERT_EQ(fastsplat_config_text(toml.data(), toml.size(), nullptr, &from_text), FASTSPLAT_OK);
  ASSERT_EQ(fastsplat_config_file(path.c_str(), &from_file), FASTSPLAT_OK) << fastsplat_last_error();
  const Config named("tiny");
  std::uint64_t hashes[3] = {};
  const fastsplat_config* configs[] = {from_text, from_file, named.handle};
  for (int i = 0; i < 3; ++i) ASSERT_EQ(fastsplat_config_hash(configs[i], &hashes[i]), FASTSPLAT_OK);
  std::printf("[figure] capi_hash = %llx (limit a hash)\n", static_cast<unsigned long long>(hashes[0]));
  EXPECT_EQ(hashes[0], cmodel::config_hash(named_config("tiny")));
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
  std::int64_t lanes = 0;
  ASSERT_EQ(fastsplat_config_value(from_text, "array.lanes", &lanes), FASTSPLAT_OK);
  EXPECT_EQ(lanes, 2);
  // A model outlives the configuration it was made from.
  fastsplat_model* model = nullptr;
  ASSERT_EQ(fastsplat_model_create(from_text, FASTSPLAT_WHOLE, 0, &model), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_config_destroy(from_text), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_config_destroy(from_file), FASTSPLAT_OK);
  const Truth& truth = truth_of("tiny");
  EXPECT_EQ(fastsplat_model_feed(model, words_of(truth.beats), truth.beats.size()), FASTSPLAT_OK);
  EXPECT_EQ(fastsplat_model_destroy(model), FASTSPLAT_OK);
}

TEST(CapiModel, NamesAndVersionsAreReported) {
  EXPECT_EQ(fastsplat_api_version(), (FASTSPLAT_API_MAJOR << 16 | FASTSPLAT_API_MINOR));
  EXPECT_STRNE(fastsplat_version(), "");
  std::vector<std::string> names, counters;
  const char* name = nullptr;
  while (fastsplat_config_name(names.size(), &name) == FASTSPLAT_OK) names.emplace_back(name);
  while (fastsplat_counter_name(counters.size(), &name) == FASTSPLAT_OK) counters.emplace_back(name);
  EXPECT_THAT(names, ::testing::IsSupersetOf({"base", "tiny", "small"}));
  EXPECT_EQ(counters.size(), static_cast<std::size_t>(FASTSPLAT_COUNTERS_CULLING));
  EXPECT_EQ(counters[2], "splats");
  EXPECT_EQ(counters[16], "busy");
}

TEST(CapiModel, ThreadsWithHandlesOfTheirOwnDoNotMeet) {
  const Config config("tiny");
  const Truth& truth = truth_of("tiny");
  std::vector<std::vector<Words>> seen(4);
  std::vector<std::string> errors(seen.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    threads.emplace_back([&, i] {
      for (int again = 0; again < 20; ++again) {
        fastsplat_model* model = nullptr;
        fastsplat_model_create(config.handle, FASTSPLAT_WHOLE, FASTSPLAT_ALL_TAPS, &model);
        fastsplat_model_feed(model, words_of(truth.beats), truth.beats.size());
        seen[i] = taps_of(model);
        fastsplat_model_destroy(model);
      }
      std::uint64_t hash = 0;
      fastsplat_config_value(config.handle, ("no.key" + std::to_string(i)).c_str(),
                             reinterpret_cast<std::int64_t*>(&hash));
      errors[i] = fastsplat_last_error();
    });
  }
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i], seen[0]);
    EXPECT_NE(errors[i].find("no.key" + std::to_string(i)), std::string::npos) << errors[i];
  }
  EXPECT_FALSE(seen[0].empty());
}

}  // namespace
}  // namespace fastsplat::test
