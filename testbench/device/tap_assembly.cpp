// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/tap_assembly.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "cmodel/cycles/cycle_stages.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/device/port_bits.hpp"

namespace fastsplat::testbench {
namespace {

constexpr cmodel::BeginTile kNone{.mode = {}, .tile = kNoTile, .x = 0, .y = 0, .width = 0, .height = 0};
constexpr std::size_t kWords = 4;  ///< of a pixel

/// Width of the halo on the left and top: with densities bank 0 holds column and row -1.
int halo_of(const cmodel::BeginTile& tile) { return cmodel::holds_densities(tile.mode) ? 1 : 0; }

}  // namespace

TapAssembly::TapAssembly(const cmodel::Config& config, cmodel::PixelSink& pixels, cmodel::TapSink& taps)
    : taps_(taps),
      lanes_(config.lanes),
      origin_bits_(config.origin_bits()),
      columns_(static_cast<std::uint32_t>(config.tile_width / config.lanes)),
      banks_(static_cast<std::size_t>(config.lanes) * config.lanes),
      sheet_fields_(port_bits(config).sheet),
      weight_fields_(port_bits(config).weight),
      state_fields_(port_bits(config).state),
      tiles_(config, pixels),
      banked_(kWords * banks_),
      payload_(kWords * banks_) {}

void TapAssembly::accept(const cmodel::Beat& beat) {
  const auto opcode = tiles_.accept(beat);
  if (opcode == cmodel::Opcode::BeginTile) {
    sheets_.emplace_back();
  } else if (sheets_.empty()) {
    return;  // outside tiles: the device ended the tile before all of its records were taken
  } else if (opcode == cmodel::Opcode::BeginSheet) {
    sheets_.back().begun.push_back(
        {static_cast<std::uint32_t>(get(beat, cmodel::layout::kSheetNumber)), sheets_.back().tags});
  } else if (opcode == cmodel::Opcode::Splat || opcode == cmodel::Opcode::Ellipse) {
    // Taken from the tag, not counted: a source may leave out hidden splats, and tags go on as if they had come.
    const auto& field = opcode == cmodel::Opcode::Splat ? cmodel::layout::kSplatTag : cmodel::layout::kEllipseTag;
    sheets_.back().tags = static_cast<std::uint32_t>(get(beat, field)) + 1;
  }
}

std::int32_t TapAssembly::origin(std::uint32_t port) const {
  return static_cast<std::int32_t>(port << (32 - origin_bits_)) >> (32 - origin_bits_);
}

const cmodel::BeginTile* TapAssembly::open_tile() const {
  return left_ < tiles_.size() ? &tiles_.tile(left_).begin : nullptr;
}

const cmodel::BeginTile& TapAssembly::tile() const { return open_tile() != nullptr ? *open_tile() : kNone; }

std::uint32_t TapAssembly::sheet_of(std::uint32_t tag) const {
  if (open_tile() == nullptr) return 0;
  const auto& begun = sheets_.front().begun;
  for (std::size_t i = begun.size(); i-- > 0;) {
    if (begun[i].first_tag <= tag) return begun[i].number;
  }
  return 0;
}

void TapAssembly::emit(cmodel::Tap tap, std::uint64_t cycle, std::uint32_t sheet, std::uint32_t tag, Place at,
                       std::span<const std::uint32_t> payload) {
  taps_.on_tap({.tap = tap,
                .tile = open_tile() == nullptr ? kNoTile : shown_tile_.value_or(tile().tile),
                .sheet = sheet,
                .tag = tag,
                .cycle = cycle,
                .x = at.x,
                .y = at.y,
                .payload = payload});
}

void TapAssembly::on_raw(const RawTap& tap) {
  shown_tile_ = tap.tile;
  switch (tap.port) {
    case RawPort::Snap:
      return snap(tap);
    case RawPort::Sheet:
      return sheet(tap);
    case RawPort::Window:
      return window(tap);
    case RawPort::Composite:
      return composite(tap);
    case RawPort::SheetDone:
      return finished_.push_back(tap.cycle);
    case RawPort::Pixels:
      return pixels(tap);
    case RawPort::Verdict:
      return;  // no tap of the model's: VerdictCheck
    case RawPort::TileLeft:
      tile_left(tap.cycle);
      if (left_ < tiles_.size()) ++left_;
      return;
  }
}

void TapAssembly::snap(const RawTap& tap) {
  const Place at{.x = origin(tap.x), .y = origin(tap.y)};
  const std::array<std::uint32_t, 4> payload{static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y), tap.mx,
                                             tap.my};
  emit(cmodel::Tap::Snap, tap.cycle, sheet_of(tap.tag), tap.tag, at, payload);
}

void TapAssembly::window(const RawTap& tap) {
  const Place at{.x = origin(tap.x), .y = origin(tap.y)};
  windows_.push_back({at, tap.tag});
  weight_fields_.unpack(tap.words.data(), banks_, banked_.data());
  const int mask = lanes_ - 1, halo = halo_of(tile());
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes_; ++j) {
    const std::uint32_t* row = &banked_[static_cast<std::size_t>((at.y + halo + j) & mask) * lanes_];
    for (int i = 0; i < lanes_; ++i) *out++ = row[(at.x + halo + i) & mask];
  }
  emit(cmodel::Tap::Footprint, tap.cycle, sheet_of(tap.tag), tap.tag, at, {payload_.data(), banks_});
}

void TapAssembly::arrange(Place at, const cmodel::BeginTile& begin, int shown) {
  const int mask = lanes_ - 1, halo = halo_of(begin);
  // A window that crosses the tile's edge keeps 0 where nothing is copied.
  const int left = std::clamp(-shown - at.x, 0, lanes_), right = std::clamp(begin.width + shown - at.x, 0, lanes_);
  const int top = std::clamp(-shown - at.y, 0, lanes_), bottom = std::clamp(begin.height + shown - at.y, 0, lanes_);
  if (right - left < lanes_ || bottom - top < lanes_) std::ranges::fill(payload_, 0);
  for (int j = top; j < bottom; ++j) {
    const std::uint32_t* row = &banked_[kWords * static_cast<std::size_t>((at.y + halo + j) & mask) * lanes_];
    std::uint32_t* out = &payload_[kWords * static_cast<std::size_t>(j) * lanes_];
    for (int i = left; i < right; ++i)
      std::copy_n(row + kWords * ((at.x + halo + i) & mask), kWords, out + kWords * static_cast<std::size_t>(i));
  }
}

TapAssembly::Window TapAssembly::next_window() {
  if (windows_.empty()) return {};
  const Window window = windows_.front();
  windows_.pop_front();
  return window;
}

void TapAssembly::sheet(const RawTap& tap) {
  const Place at = next_window().at;
  sheet_fields_.unpack(tap.words.data(), kWords * banks_, banked_.data());
  arrange(at, tile(), halo_of(tile()));
  emit(cmodel::Tap::Sheet, tap.cycle, sheet_of(tap.tag), tap.tag, at, payload_);
}

void TapAssembly::composite(const RawTap& tap) {
  if (cmodel::every_sample(tile().mode)) {
    const Window window = next_window();
    state_fields_.unpack(tap.words.data(), kWords * banks_, banked_.data());
    arrange(window.at, tile());
    // The port's block must be 0 here; any other value makes the place differ.
    const Place at{.x = window.at.x + static_cast<std::int32_t>(tap.block), .y = window.at.y};
    emit(cmodel::Tap::Composite, tap.cycle, sheet_of(window.tag), window.tag, at, payload_);
    return;
  }
  pass_sheets(tap.cycle);
  const int halo = halo_of(tile());
  const Place at{.x = static_cast<std::int32_t>(tap.block % columns_) * lanes_ - halo,
                 .y = static_cast<std::int32_t>(tap.block / columns_) * lanes_ - halo};
  state_fields_.unpack(tap.words.data(), kWords * banks_, banked_.data());
  arrange(at, tile());
  emit(cmodel::Tap::Composite, tap.cycle, composited_sheet(), 0, at, payload_);
}

void TapAssembly::pass_sheets(std::uint64_t cycle) {
  for (; !finished_.empty() && finished_.front() + cmodel::stages::kComposite < cycle; finished_.pop_front())
    if (!sheets_.empty()) ++sheets_.front().composited;
}

std::uint32_t TapAssembly::composited_sheet() const {
  if (sheets_.empty()) return 0;
  const Sheets& sheets = sheets_.front();
  return sheets.composited < sheets.begun.size() ? sheets.begun[sheets.composited].number : 0;
}

void TapAssembly::tile_left(std::uint64_t cycle) {
  if (sheets_.empty()) return;
  // A tile of one beat may end in the very cycle that counts its last, empty sheet.
  pass_sheets(cycle + 1);
  sheets_.pop_front();
}

void TapAssembly::pixels(const RawTap& tap) {
  const std::size_t behind = std::exchange(left_, 0);  // pixels are the earliest tile's
  const auto place = tiles_.complete() ? TileAssembly::Place{.x = 0, .y = 0, .count = lanes_} : tiles_.next_place();
  const std::uint32_t keep = tap.keep.value_or(static_cast<std::uint32_t>((std::uint64_t{1} << place.count) - 1));
  for (int i = 0; i < lanes_; ++i) {
    if ((keep >> i & 1) == 0) continue;
    emit(cmodel::Tap::Pixel, tap.cycle, 0, 0, {.x = place.x + i, .y = place.y},
         tap.words.subspan(kWords * static_cast<std::size_t>(i), kWords));
  }
  if (tap.last && behind == 0) tile_left(tap.cycle);
  left_ = tap.last && behind > 0 ? behind - 1 : behind;
  tiles_.pixels(tap.words, tap.last);
}

}  // namespace fastsplat::testbench
