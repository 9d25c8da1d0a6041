// SPDX-License-Identifier: Apache-2.0
// The pixel stage's lane standalone, a pixel a cycle, compared with ClassifyUnit. An error in a last bit shows once in
// a million pixels; whole streams have too few (docs/numerics.md, section 6.2).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cmodel/classify/classify_unit.hpp"
#include "cmodel/cycles/cycle_stages.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stimulus_tables.hpp"
#include "verilated.h"

namespace fastsplat::test {

/// The densities of a pixel and its neighbours, and its place.
struct LanePixel {
  std::uint32_t here = 0, left = 0, right = 0, above = 0, below = 0, before = 0, behind = 0;
  std::int32_t x = 0, y = 0;
};

/// Tables, scales and a picture's sides, and pixels whose slopes are near the start of shading.
class LaneStimulus {
 public:
  LaneStimulus(const cmodel::Config& config, std::uint64_t seed) : config_(config), random_(seed) {}

  static constexpr int kPixels = 4096;  ///< of a set of tables
  void next_tables();
  LanePixel pixel();
  cmodel::SheetWord expected(const LanePixel& pixel) const;

  /// A table's entries: of CLASSIFY channel `channel` of four.
  std::vector<std::uint32_t> entries(cmodel::Table table, int channel) const;
  const std::vector<std::uint32_t>& lighting() const { return lighting_; }
  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  std::uint32_t scales() const { return sheets_[0]; }
  std::uint32_t per_floor() const { return sheets_[1]; }

 private:
  std::uint32_t near(std::uint32_t word);
  void edge_tables(int which);

  const cmodel::Config& config_;
  testbench::Random random_;
  std::vector<std::uint32_t> classify_, root_, glint_, lighting_, sheets_;
  std::optional<cmodel::ClassifyUnit> unit_;
  std::int32_t width_ = 1, height_ = 1;
  std::int64_t step_ = 0;  ///< largest difference between neighbours
  int sets_ = 0;
  std::optional<std::uint32_t> rise_{};  ///< of all pixels from left to right, without another slope
};

struct LaneResult {
  std::uint64_t pixels = 0;
  std::string different;  ///< the first difference, or empty
};

/// Top: the Verilated fastsplat_classify_lane.
template <class Top>
class LaneBench {
 public:
  explicit LaneBench(const cmodel::Config& config) : config_(config) {
    context_.threads(1);
    context_.randReset(2);
    top_ = std::make_unique<Top>(&context_);
  }
  ~LaneBench() { top_->final(); }

  LaneResult run(std::uint64_t seed, int sets_of_tables) {
    LaneStimulus stimulus(config_, seed);
    LaneResult result;
    for (int set = 0; set < sets_of_tables && result.different.empty(); ++set) {
      stimulus.next_tables();
      load(stimulus);
      play(stimulus, result);
    }
    return result;
  }

 private:
  static constexpr int kStages = static_cast<int>(cmodel::stages::kPixelStage);  ///< registers (M-density-19)

  void clock() {
    top_->clk_i = 0;
    top_->eval();
    top_->clk_i = 1;
    top_->eval();
  }
  /// Adds `value` at bit `at` to a port of any width, which is 0 there.
  template <class Port>
  static void put(Port& port, std::uint64_t value, int at = 0) {
    if constexpr (std::is_integral_v<Port>) {
      port |= static_cast<Port>(value << at);
    } else {
      for (int bit = 0; bit < 64; ++bit)
        if ((value >> bit & 1) != 0) port[(at + bit) / 32] |= 1U << ((at + bit) % 32);
    }
  }
  template <class Port>
  static void clear(Port& port) {
    if constexpr (std::is_integral_v<Port>)
      port = 0;
    else
      for (std::size_t i = 0; i < sizeof(port) / sizeof(port[0]); ++i) port[i] = 0;
  }
  template <class Port>
  static std::uint32_t get(const Port& port, int at, int bits) {
    std::uint64_t out = 0;
    for (int bit = 0; bit < bits; ++bit) {
      std::uint64_t one = 0;
      if constexpr (std::is_integral_v<Port>)
        one = static_cast<std::uint64_t>(port) >> (at + bit) & 1;
      else
        one = port[(at + bit) / 32] >> ((at + bit) % 32) & 1;
      out |= one << bit;
    }
    return static_cast<std::uint32_t>(out);
  }

  /// Segments as classify_tables makes them: {entry, the next one}.
  void load(const LaneStimulus& stimulus) {
    const int word = std::max(cmodel::classify::kColour + 1, config_.sheet_int_bits + config_.sheet_frac_bits);
    const auto segments = [&](int memory, const std::vector<std::uint32_t>& entries) {
      for (std::size_t i = 0; i + 1 < entries.size(); ++i) {
        top_->segment_we_i = static_cast<std::uint8_t>(1 << memory);
        top_->segment_i = static_cast<std::uint8_t>(i);
        clear(top_->segment_word_i);
        put(top_->segment_word_i, entries[i], word);
        put(top_->segment_word_i, entries[i + 1]);
        clock();
      }
    };
    for (int channel = 0; channel < 4; ++channel) segments(channel, stimulus.entries(cmodel::Table::Classify, channel));
    segments(4, stimulus.entries(cmodel::Table::Root, 0));
    segments(5, stimulus.entries(cmodel::Table::Glint, 0));
    top_->segment_we_i = 0;
    clear(top_->lighting_i);
    for (std::size_t i = 0; i < stimulus.lighting().size(); ++i)
      put(top_->lighting_i, stimulus.lighting()[i], 32 * static_cast<int>(i));
    top_->image_width_i = static_cast<std::uint16_t>(stimulus.width());
    top_->image_height_i = static_cast<std::uint16_t>(stimulus.height());
    top_->scales_i = stimulus.scales();
    top_->floor_i = stimulus.per_floor();
  }

  void play(LaneStimulus& stimulus, LaneResult& result) {
    std::array<LanePixel, kStages> on_its_way;
    const int bits = config_.sheet_int_bits + config_.sheet_frac_bits;
    for (int cycle = 0; cycle < LaneStimulus::kPixels + kStages - 1; ++cycle) {
      const LanePixel pixel = stimulus.pixel();
      on_its_way[static_cast<std::size_t>(cycle % kStages)] = pixel;
      top_->here_i = pixel.here;
      top_->left_i = pixel.left;
      top_->right_i = pixel.right;
      top_->above_i = pixel.above;
      top_->below_i = pixel.below;
      top_->before_i = pixel.before;
      top_->behind_i = pixel.behind;
      top_->x_i = static_cast<std::uint16_t>(pixel.x);
      top_->y_i = static_cast<std::uint16_t>(pixel.y);
      clock();
      if (cycle < kStages - 1) continue;
      // The pixel put in 23 edges ago, including this one (M-density-19): a lane of another length outputs another one.
      const LanePixel& out = on_its_way[static_cast<std::size_t>((cycle + 1) % kStages)];
      const cmodel::SheetWord expected = stimulus.expected(out);
      ++result.pixels;
      for (int c = 0; c < 4; ++c) {
        const std::uint32_t got = get(top_->sums_o, c * bits, bits);
        if (got == expected[static_cast<std::size_t>(c)] || !result.different.empty()) continue;
        result.different = "pixel " + std::to_string(result.pixels - 1) + " channel " + std::to_string(c) +
                           ": expected " + std::to_string(expected[static_cast<std::size_t>(c)]) + ", got " +
                           std::to_string(got);
      }
    }
  }

  const cmodel::Config& config_;
  VerilatedContext context_;
  std::unique_ptr<Top> top_;
};

}  // namespace fastsplat::test
