// SPDX-License-Identifier: Apache-2.0
#include "tests/check/raw_replay_helper.hpp"

#include <algorithm>
#include <deque>

#include "cmodel/cycles/cycle_stages.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/model.hpp"

namespace fastsplat::test {
namespace {

using testbench::RawPort;

/// A vector port: fields of equal width, one after another.
class Port {
 public:
  Port(std::size_t fields, int bits) : bits_(static_cast<std::size_t>(bits)), words_((fields * bits_ + 31) / 32, ~0U) {}
  void set(std::size_t field, std::uint32_t value) {
    for (std::size_t bit = 0; bit < bits_; ++bit) {
      const std::size_t at = field * bits_ + bit;
      const std::uint32_t one = 1U << at % 32;
      words_[at / 32] = (value >> bit & 1) != 0 ? words_[at / 32] | one : words_[at / 32] & ~one;
    }
  }
  std::vector<std::uint32_t> take() { return std::move(words_); }

 private:
  std::size_t bits_;
  std::vector<std::uint32_t> words_;
};

class Replay final : public cmodel::TapSink, public cmodel::PixelSink {
 public:
  explicit Replay(const cmodel::Config& config)
      : config_(config),
        lanes_(static_cast<std::size_t>(config.lanes)),
        decode_(config, cmodel::StreamScope::Whole),
        model_(config, cmodel::StreamScope::Whole, *this, this) {}

  void take(const cmodel::Beat& beat) {
    events.push_back({.beat = beat, .tap = {}, .words = {}});
    const cmodel::Record* record = decode_.feed(beat);
    const auto* tile = record == nullptr ? nullptr : std::get_if<cmodel::BeginTile>(record);
    if (tile != nullptr) tile_ = *tile;
    const bool ends_sheet = record != nullptr && std::holds_alternative<cmodel::EndSheet>(*record);
    if (ends_sheet) show_sums(0);
    model_.consume({&beat, 1});
    if (!ends_sheet) return;
    show({.port = RawPort::SheetDone, .words = {}}, {});
    cycle_ += cmodel::stages::kComposite;
  }

  void on_tap(const cmodel::TapRecord& record) override {
    switch (record.tap) {
      case cmodel::Tap::Snap:
        return show({.port = RawPort::Snap,
                     .tag = record.tag,
                     .x = origin(record.x),
                     .y = origin(record.y),
                     .mx = record.payload[2],
                     .my = record.payload[3],
                     .words = {}},
                    {});
      case cmodel::Tap::Footprint:
        return window(record);
      case cmodel::Tap::Sheet:
        return sums(record);
      case cmodel::Tap::Composite:
        return composite(record);
      case cmodel::Tap::Pixel:
        return;  // on_tile has them all
    }
  }

  void on_tile(cmodel::TilePixels&& tile) override {
    const auto width = static_cast<std::size_t>(tile.width), height = static_cast<std::size_t>(tile.height);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; x += lanes_) {
        std::vector<std::uint32_t> words(4 * lanes_, ~0U);
        const auto from = tile.words.begin() + static_cast<std::ptrdiff_t>((y * width + x) * 4);
        std::copy_n(from, 4 * std::min(lanes_, width - x), words.begin());
        const auto kept = static_cast<std::uint32_t>(std::min(lanes_, width - x));
        show({.port = RawPort::Pixels,
              .last = y + 1 == height && x + lanes_ >= width,
              .keep = (1U << kept) - 1,
              .words = {}},
             std::move(words));
      }
    }
  }

  std::vector<RawEvent> events;

 private:
  /// The bank of pixel (x, y), which may lie left of the tile or above it (M-tap-2).
  std::size_t bank(std::int32_t x, std::int32_t y) const {
    const std::int32_t mask = config_.lanes - 1;
    return static_cast<std::size_t>(y & mask) * lanes_ + static_cast<std::size_t>(x & mask);
  }
  std::uint32_t origin(std::int32_t value) const {
    return static_cast<std::uint32_t>(value) & ((1U << config_.origin_bits()) - 1);
  }
  bool inside(std::int32_t x, std::int32_t y) const { return x >= 0 && y >= 0 && x < tile_.width && y < tile_.height; }

  /// M-tap-3
  void window(const cmodel::TapRecord& record) {
    Port port(lanes_ * lanes_, config_.radial_int_bits + config_.radial_frac_bits);
    auto weight = record.payload.begin();
    for (std::int32_t j = 0; j < config_.lanes; ++j)
      for (std::int32_t i = 0; i < config_.lanes; ++i) port.set(bank(record.x + i, record.y + j), *weight++);
    show({.port = RawPort::Window, .tag = record.tag, .x = origin(record.x), .y = origin(record.y), .words = {}},
         port.take());
  }

  std::vector<std::uint32_t> four_by_bank(const cmodel::TapRecord& record, int bits) const {
    Port port(lanes_ * lanes_ * 4, bits);
    auto word = record.payload.begin();
    for (std::int32_t j = 0; j < config_.lanes; ++j) {
      for (std::int32_t i = 0; i < config_.lanes; ++i, word += 4) {
        if (!inside(record.x + i, record.y + j)) continue;  // M-tap-4
        // M-tap-3
        for (std::size_t c = 0; c < 4; ++c) port.set(bank(record.x + i, record.y + j) * 4 + c, word[c]);
      }
    }
    return port.take();
  }

  void sums(const cmodel::TapRecord& record) {
    sums_.push_back({.beat = std::nullopt,
                     .tap = {.port = RawPort::Sheet, .tag = record.tag, .words = {}},
                     .words = four_by_bank(record, config_.sheet_int_bits + config_.sheet_frac_bits)});
    show_sums(kSumsLater);
  }
  void show_sums(std::size_t kept) {
    for (; sums_.size() > kept; sums_.pop_front()) show(sums_.front().tap, std::move(sums_.front().words));
  }

  void composite(const cmodel::TapRecord& record) {
    const auto column = static_cast<std::uint32_t>(record.x / config_.lanes),
               row = static_cast<std::uint32_t>(record.y / config_.lanes),
               columns = static_cast<std::uint32_t>(config_.tile_width / config_.lanes);
    // M-tap-5
    show({.port = RawPort::Composite, .block = row * columns + column, .words = {}},
         four_by_bank(record,
                      std::max(config_.sheet_int_bits + config_.sheet_frac_bits, config_.composite_frac_bits + 1)));
  }

  void show(testbench::RawTap tap, std::vector<std::uint32_t> words) {
    tap.cycle = ++cycle_;
    tap.tile = tile_.tile;
    events.push_back({.beat = std::nullopt, .tap = tap, .words = std::move(words)});
  }

  cmodel::Config config_;
  std::size_t lanes_;
  cmodel::StreamDecode decode_;
  cmodel::Model model_;
  cmodel::BeginTile tile_;
  std::deque<RawEvent> sums_;
  std::uint64_t cycle_ = 0;
};

}  // namespace

std::vector<RawEvent> replay(const cmodel::Config& config, std::span<const cmodel::Beat> beats) {
  Replay replay(config);
  for (const auto& beat : beats) replay.take(beat);
  return std::move(replay.events);
}

void play(std::span<const RawEvent> events, testbench::RawTapSink& sink) {
  for (const auto& event : events) {
    if (event.beat) {
      sink.accept(*event.beat);
    } else {
      testbench::RawTap tap = event.tap;
      tap.words = event.words;
      sink.on_raw(tap);
    }
  }
}

}  // namespace fastsplat::test
