// SPDX-License-Identifier: Apache-2.0
// The operands shown for a differing word are that word's own: column and row of the footprint, channel and pixel. This
// test looks them up in the stream's tables, by the page.
#include "testbench/triage/explain.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/model.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {
namespace {

using testbench::TapCopy;

struct Taps final : cmodel::TapSink, cmodel::PixelSink {
  std::vector<TapCopy> records;
  void on_tap(const cmodel::TapRecord& record) override { records.push_back(testbench::copy(record)); }
  void on_tile(cmodel::TilePixels&&) override {}
};

std::string hex(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%llX", static_cast<unsigned long long>(value));
  return text;
}

/// A stream of footprints of many windows, all taps that the model makes of it, and its only radius set.
class Explained : public ::testing::Test {
 protected:
  const cmodel::Config config_ = named_config("tiny");
  const testbench::StreamDocument document_ =
      make_stimulus(config_, testbench::StimulusClass::MultiWindow, 2, 12).document;
  const std::vector<cmodel::Beat> beats_ = write_document(config_, document_);
  Taps taps_;

  void SetUp() override {
    cmodel::Model model(config_, cmodel::StreamScope::Whole, taps_, &taps_);
    model.consume(beats_);
  }

  std::string explained(const TapCopy& record, std::size_t word) const {
    testbench::Divergence divergence{.model = record, .rtl = record, .word = word, .header = false};
    return explain([&](const auto& sink) { sink(beats_); }, config_, divergence);
  }

  /// The table loaded last.
  const cmodel::LoadTable& table(cmodel::Table which) const {
    const cmodel::LoadTable* found = nullptr;
    for (const auto& one : document_.tables)
      if (one.table == which) found = &one;
    return *found;
  }
};

TEST_F(Explained, AWeightByItsOwnColumnAndRow) {
  const auto& rlut = table(cmodel::Table::Rlut);
  const auto& radial = table(cmodel::Table::Radial);
  const std::size_t extent = rlut.words.size() / static_cast<std::size_t>(config_.phases);
  const auto lanes = static_cast<std::size_t>(config_.lanes);
  ASSERT_GT(extent, lanes) << "one window only";
  const TapCopy* snap = nullptr;
  int compared = 0, beyond_the_first_window = 0;
  for (const auto& record : taps_.records) {
    if (record.tap == cmodel::Tap::Snap) snap = &record;
    if (record.tap != cmodel::Tap::Footprint) continue;
    for (std::size_t word = 0; word < lanes * lanes; ++word) {
      const auto column = static_cast<std::size_t>(record.x - snap->x) + word % lanes,
                 row = static_cast<std::size_t>(record.y - snap->y) + word / lanes;
      const auto look = [&](std::uint32_t phase, std::size_t at) { return rlut.words[phase * extent + at]; };
      const std::uint32_t mx = snap->payload[2], my = snap->payload[3], q = look(mx, column) + look(my, row),
                          index = q >> config_.rlut_guard_bits;
      const auto name = [&](std::uint32_t phase, std::size_t at) {
        return "RLUT[0][" + std::to_string(phase) + "][" + std::to_string(at) + "]=" + hex(look(phase, at));
      };
      const std::string expected = name(mx, column) + " + " + name(my, row) + ": q=" + hex(q) +
                                   ", index=" + std::to_string(index) +
                                   (index < radial.words.size() ? ", RADIAL=" + hex(radial.words[index])
                                                                : ", at or beyond the footprint's edge: 0");
      EXPECT_EQ(explained(record, word), expected);
      ++compared;
      if (column >= lanes && row >= lanes && column != row) ++beyond_the_first_window;
    }
    if (compared > 400) break;
  }
  std::printf("[figure] weights explained = %d, beyond the first window = %d (limit > 0)\n", compared,
              beyond_the_first_window);
  EXPECT_GT(beyond_the_first_window, 0);
}

TEST_F(Explained, ASumByItsOwnChannelAndWeight) {
  static constexpr const char* kChannels[] = {"R", "G", "B", "tau"};
  const auto lanes = static_cast<std::size_t>(config_.lanes);
  const TapCopy* weights = nullptr;
  int compared = 0;
  for (const auto& record : taps_.records) {
    if (record.tap == cmodel::Tap::Footprint) weights = &record;
    if (record.tap != cmodel::Tap::Sheet) continue;
    const auto& tile = document_.tiles.at(record.tile);
    std::size_t tag = record.tag;
    const cmodel::SplatRecord* splat = nullptr;
    for (const auto& sheet : tile.sheets) {
      for (const auto& one : sheet.records) {
        const auto* found = std::get_if<cmodel::SplatRecord>(&one);
        if (found != nullptr && tag-- == 0) splat = found;
      }
    }
    ASSERT_NE(splat, nullptr);
    for (std::size_t word = 0; word < lanes * lanes * 4; ++word) {
      const std::size_t lane = word / 4, channel = word % 4;
      const auto x = record.x + static_cast<std::int32_t>(lane % lanes),
                 y = record.y + static_cast<std::int32_t>(lane / lanes);
      const std::string text = explained(record, word),
                        pixel = "pixel (" + std::to_string(x) + "," + std::to_string(y) + ")";
      EXPECT_EQ(text.rfind(pixel, 0), 0u) << text;
      const bool inside = x >= 0 && y >= 0 && x < tile.begin.width && y < tile.begin.height;
      EXPECT_NE(text.find(inside ? std::string("colour ") + kChannels[channel] + "=" + hex(splat->colour[channel]) +
                                       " x weight " + hex(weights->payload[lane]) + " = product "
                                 : " is outside the tile"),
                std::string::npos)
          << text;
      ++compared;
    }
    if (compared > 800) break;
  }
  std::printf("[figure] sums explained = %d (limit > 0)\n", compared);
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace fastsplat::test
