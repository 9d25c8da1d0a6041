#include "testbench/device/tap_assembly.hpp"

#include "cmodel/cycle_stages.hpp"
#include "cmodel/records.hpp"
#include "testbench/device/port_bits.hpp"

namespace fastsplat::testbench {
namespace {

/// Bits lsb .. lsb+bits-1 of a vector of 32-bit words.
std::uint32_t field(std::span<const std::uint32_t> words, std::size_t lsb, int bits) {
  const std::size_t word = lsb / 32;
  const int shift = static_cast<int>(lsb % 32);
  std::uint64_t value = words[word] >> shift;
  if (shift + bits > 32) value |= static_cast<std::uint64_t>(words[word + 1]) << (32 - shift);
  return static_cast<std::uint32_t>(value & ((std::uint64_t{1} << bits) - 1));
}

}  // namespace

TapAssembly::TapAssembly(const cmodel::Config& config, cmodel::PixelSink& pixels, cmodel::TapSink& taps)
    : config_(config),
      taps_(taps),
      sheet_bits_(port_bits(config).sheet),
      weight_bits_(port_bits(config).weight),
      state_bits_(port_bits(config).state),
      tiles_(config, pixels) {}

void TapAssembly::accept(const cmodel::Beat& beat) {
  const auto opcode = tiles_.accept(beat);
  if (opcode == cmodel::Opcode::BeginTile) {
    sheets_.emplace_back();
  } else if (sheets_.empty()) {
    return;  // of no tile: the device ended it before its records were all taken
  } else if (opcode == cmodel::Opcode::BeginSheet) {
    sheets_.back().begun.push_back(
        {static_cast<std::uint32_t>(get(beat, cmodel::layout::kSheetNumber)), sheets_.back().tags});
  } else if (opcode == cmodel::Opcode::Splat) {
    ++sheets_.back().tags;
  }
}

std::int32_t TapAssembly::origin(std::uint32_t port) const {
  const int bits = config_.position_int_bits + 2;
  return static_cast<std::int32_t>(port << (32 - bits)) >> (32 - bits);
}

cmodel::BeginTile TapAssembly::tile() const {
  if (tiles_.complete()) return {.mode = {}, .tile = kNoTile, .x = 0, .y = 0, .width = 0, .height = 0};
  return tiles_.front().begin;
}

std::uint32_t TapAssembly::sheet_of(std::uint32_t tag) const {
  if (tiles_.complete()) return 0;
  const auto& begun = sheets_.front().begun;
  for (std::size_t i = begun.size(); i-- > 0;) {
    if (begun[i].first_tag <= tag) return begun[i].number;
  }
  return 0;
}

void TapAssembly::emit(cmodel::Tap tap, std::uint64_t cycle, std::uint32_t sheet, std::uint32_t tag, std::int32_t x,
                       std::int32_t y) {
  taps_.on_tap({.tap = tap,
                .tile = tiles_.complete() ? kNoTile : shown_tile_.value_or(tile().tile),
                .sheet = sheet,
                .tag = tag,
                .cycle = cycle,
                .x = x,
                .y = y,
                .payload = payload_});
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
  }
}

void TapAssembly::snap(const RawTap& tap) {
  const std::int32_t x = origin(tap.x), y = origin(tap.y);
  payload_ = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), tap.mx, tap.my};
  emit(cmodel::Tap::Snap, tap.cycle, sheet_of(tap.tag), tap.tag, x, y);
}

void TapAssembly::window(const RawTap& tap) {
  const std::int32_t x = origin(tap.x), y = origin(tap.y);
  windows_.push_back({x, y});
  const int lanes = config_.lanes, mask = lanes - 1;
  payload_.resize(static_cast<std::size_t>(lanes) * lanes);
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes; ++j) {
    for (int i = 0; i < lanes; ++i) {
      const auto bank = static_cast<std::size_t>(((y + j) & mask) * lanes + ((x + i) & mask));
      *out++ = field(tap.words, bank * weight_bits_, weight_bits_);
    }
  }
  emit(cmodel::Tap::Footprint, tap.cycle, sheet_of(tap.tag), tap.tag, x, y);
}

void TapAssembly::sheet(const RawTap& tap) {
  Place at;
  if (!windows_.empty()) {
    at = windows_.front();
    windows_.pop_front();
  }
  const cmodel::BeginTile begin = tile();
  const int lanes = config_.lanes, mask = lanes - 1;
  payload_.assign(static_cast<std::size_t>(lanes) * lanes * 4, 0);
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes; ++j) {
    for (int i = 0; i < lanes; ++i, out += 4) {
      const std::int32_t x = at.x + i, y = at.y + j;
      if (x < 0 || y < 0 || x >= begin.width || y >= begin.height) continue;
      const auto bank = static_cast<std::size_t>((y & mask) * lanes + (x & mask));
      for (std::size_t c = 0; c < 4; ++c) out[c] = field(tap.words, (bank * 4 + c) * sheet_bits_, sheet_bits_);
    }
  }
  emit(cmodel::Tap::Sheet, tap.cycle, sheet_of(tap.tag), tap.tag, at.x, at.y);
}

void TapAssembly::composite(const RawTap& tap) {
  pass_sheets(tap.cycle);
  const cmodel::BeginTile begin = tile();
  const int lanes = config_.lanes;
  const auto columns = static_cast<std::uint32_t>(config_.tile_width / lanes);
  const auto x0 = static_cast<std::int32_t>(tap.block % columns) * lanes,
             y0 = static_cast<std::int32_t>(tap.block / columns) * lanes;
  payload_.assign(static_cast<std::size_t>(lanes) * lanes * 4, 0);
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes; ++j) {
    for (int i = 0; i < lanes; ++i, out += 4) {
      if (x0 + i >= begin.width || y0 + j >= begin.height) continue;
      const auto bank = static_cast<std::size_t>(j * lanes + i);
      for (std::size_t c = 0; c < 4; ++c) out[c] = field(tap.words, (bank * 4 + c) * state_bits_, state_bits_);
    }
  }
  emit(cmodel::Tap::Composite, tap.cycle, composited_sheet(), 0, x0, y0);
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

void TapAssembly::pixels(const RawTap& tap) {
  const auto place =
      tiles_.complete() ? TileAssembly::Place{.x = 0, .y = 0, .count = config_.lanes} : tiles_.next_place();
  const std::uint32_t keep = tap.keep.value_or(static_cast<std::uint32_t>((std::uint64_t{1} << place.count) - 1));
  for (int i = 0; i < config_.lanes; ++i) {
    if ((keep >> i & 1) == 0) continue;
    const auto pixel = tap.words.subspan(4 * static_cast<std::size_t>(i), 4);
    payload_.assign(pixel.begin(), pixel.end());
    emit(cmodel::Tap::Pixel, tap.cycle, 0, 0, place.x + i, place.y);
  }
  if (tap.last && !sheets_.empty()) {
    // A tile of one beat may end in the very cycle that counts its last, empty sheet.
    pass_sheets(tap.cycle + 1);
    sheets_.pop_front();
  }
  tiles_.pixels(tap.words, tap.last);
}

}  // namespace fastsplat::testbench
