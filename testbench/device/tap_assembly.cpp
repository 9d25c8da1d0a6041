#include "testbench/device/tap_assembly.hpp"

#include "cmodel/cycle_stages.hpp"

namespace fastsplat::testbench {
namespace {

/// Bits lsb .. lsb+bits-1 of a vector of 32-bit words.
std::uint32_t field(const std::uint32_t* words, std::size_t lsb, int bits) {
  const std::size_t word = lsb / 32;
  const int shift = static_cast<int>(lsb % 32);
  std::uint64_t value = words[word] >> shift;
  if (shift + bits > 32) value |= static_cast<std::uint64_t>(words[word + 1]) << (32 - shift);
  return static_cast<std::uint32_t>(value & ((std::uint64_t{1} << bits) - 1));
}

}  // namespace

TapAssembly::TapAssembly(const cmodel::Config& config, cmodel::PixelSink& pixels, cmodel::TapSink* taps)
    : config_(config),
      pixels_(pixels),
      taps_(taps),
      sheet_bits_(config.sheet_int_bits + config.sheet_frac_bits),
      weight_bits_(config.radial_int_bits + config.radial_frac_bits),
      state_bits_(std::max(config.sheet_int_bits + config.sheet_frac_bits, config.composite_frac_bits + 1)) {}

void TapAssembly::reset() {
  tiles_.clear();
  windows_.clear();
  finished_.clear();
  payload_left_ = 0;
}

void TapAssembly::accept(const cmodel::Beat& beat) {
  if (payload_left_ > 0) {
    --payload_left_;
    return;
  }
  switch (static_cast<cmodel::Opcode>(get(beat, cmodel::layout::kOpcode))) {
    case cmodel::Opcode::LoadTable:
      payload_left_ = (std::uint64_t{cmodel::announced_words(beat)} + 5) / 6;
      break;
    case cmodel::Opcode::BeginTile: {
      Tile tile;
      tile.begin = std::get<cmodel::BeginTile>(cmodel::from_beat(beat));
      tile.out = {.tile = tile.begin.tile,
                  .x = tile.begin.x,
                  .y = tile.begin.y,
                  .width = tile.begin.width,
                  .height = tile.begin.height,
                  .words = {}};
      tile.out.words.reserve(static_cast<std::size_t>(tile.begin.width) * tile.begin.height * 4);
      tiles_.push_back(std::move(tile));
      break;
    }
    case cmodel::Opcode::BeginSheet:
      tiles_.back().sheets.push_back(
          {static_cast<std::uint32_t>(get(beat, cmodel::layout::kSheetNumber)), tiles_.back().tags});
      break;
    case cmodel::Opcode::Splat:
      ++tiles_.back().tags;
      break;
    default:
      break;
  }
}

std::int32_t TapAssembly::origin(std::uint32_t port) const {
  const int bits = config_.position_int_bits + 2;
  return static_cast<std::int32_t>(port << (32 - bits)) >> (32 - bits);
}

std::uint32_t TapAssembly::sheet_of(const Tile& tile, std::uint32_t tag) const {
  for (std::size_t i = tile.sheets.size(); i-- > 0;) {
    if (tile.sheets[i].first_tag <= tag) return tile.sheets[i].number;
  }
  return 0;
}

void TapAssembly::emit(cmodel::Tap tap, std::uint64_t cycle, std::uint32_t sheet, std::uint32_t tag, std::int32_t x,
                       std::int32_t y) {
  taps_->on_tap({.tap = tap,
                 .tile = tiles_.front().begin.tile,
                 .sheet = sheet,
                 .tag = tag,
                 .cycle = cycle,
                 .x = x,
                 .y = y,
                 .payload = payload_});
}

void TapAssembly::snap(std::uint64_t cycle, std::uint32_t tag, std::int32_t x, std::int32_t y, std::uint32_t mx,
                       std::uint32_t my) {
  if (tiles_.empty()) return;
  payload_ = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), mx, my};
  emit(cmodel::Tap::Snap, cycle, sheet_of(tiles_.front(), tag), tag, x, y);
}

void TapAssembly::window(std::uint64_t cycle, std::uint32_t tag, std::int32_t x, std::int32_t y,
                         const std::uint32_t* weights) {
  windows_.push_back({x, y});
  if (tiles_.empty()) return;
  const int lanes = config_.lanes, mask = lanes - 1;
  payload_.resize(static_cast<std::size_t>(lanes) * lanes);
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes; ++j) {
    for (int i = 0; i < lanes; ++i) {
      const auto bank = static_cast<std::size_t>(((y + j) & mask) * lanes + ((x + i) & mask));
      *out++ = field(weights, bank * weight_bits_, weight_bits_);
    }
  }
  emit(cmodel::Tap::Footprint, cycle, sheet_of(tiles_.front(), tag), tag, x, y);
}

void TapAssembly::sheet(std::uint64_t cycle, std::uint32_t tag, const std::uint32_t* sums) {
  if (windows_.empty() || tiles_.empty()) return;
  const Place at = windows_.front();
  windows_.pop_front();
  const auto& begin = tiles_.front().begin;
  const int lanes = config_.lanes, mask = lanes - 1;
  payload_.assign(static_cast<std::size_t>(lanes) * lanes * 4, 0);
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes; ++j) {
    for (int i = 0; i < lanes; ++i, out += 4) {
      const std::int32_t x = at.x + i, y = at.y + j;
      if (x < 0 || y < 0 || x >= begin.width || y >= begin.height) continue;
      const auto bank = static_cast<std::size_t>((y & mask) * lanes + (x & mask));
      for (std::size_t c = 0; c < 4; ++c) out[c] = field(sums, (bank * 4 + c) * sheet_bits_, sheet_bits_);
    }
  }
  emit(cmodel::Tap::Sheet, cycle, sheet_of(tiles_.front(), tag), tag, at.x, at.y);
}

void TapAssembly::composite(std::uint64_t cycle, std::uint32_t block, const std::uint32_t* state) {
  if (tiles_.empty()) return;
  const Tile& tile = tiles_.front();
  const int lanes = config_.lanes;
  const auto columns = static_cast<std::uint32_t>(config_.tile_width / lanes);
  const auto x0 = static_cast<std::int32_t>(block % columns) * lanes,
             y0 = static_cast<std::int32_t>(block / columns) * lanes;
  payload_.assign(static_cast<std::size_t>(lanes) * lanes * 4, 0);
  std::uint32_t* out = payload_.data();
  for (int j = 0; j < lanes; ++j) {
    for (int i = 0; i < lanes; ++i, out += 4) {
      if (x0 + i >= tile.begin.width || y0 + j >= tile.begin.height) continue;
      const auto bank = static_cast<std::size_t>(j * lanes + i);
      for (std::size_t c = 0; c < 4; ++c) out[c] = field(state, (bank * 4 + c) * state_bits_, state_bits_);
    }
  }
  const std::uint32_t sheet = tile.composited < tile.sheets.size() ? tile.sheets[tile.composited].number : 0;
  emit(cmodel::Tap::Composite, cycle, sheet, 0, x0, y0);
}

void TapAssembly::sheet_done(std::uint64_t cycle, bool done) {
  if (!finished_.empty() && finished_.front() + cmodel::stages::kComposite == cycle) {
    finished_.pop_front();
    if (!tiles_.empty()) ++tiles_.front().composited;
  }
  if (done) finished_.push_back(cycle);
}

void TapAssembly::pixels(std::uint64_t cycle, const std::uint32_t* words, bool last) {
  if (tiles_.empty()) return;
  Tile& tile = tiles_.front();
  const int lanes = config_.lanes, beats_per_row = (tile.begin.width + lanes - 1) / lanes;
  const auto y = static_cast<std::int32_t>(tile.taken) / beats_per_row;
  const auto x0 = static_cast<std::int32_t>(tile.taken) % beats_per_row * lanes;
  for (int i = 0; i < lanes && x0 + i < tile.begin.width; ++i) {
    payload_.assign(words + 4 * i, words + 4 * i + 4);
    tile.out.words.insert(tile.out.words.end(), payload_.begin(), payload_.end());
    if (taps_ != nullptr) emit(cmodel::Tap::Pixel, cycle, 0, 0, x0 + i, y);
  }
  ++tile.taken;
  if (!last) return;
  cmodel::TilePixels out = std::move(tile.out);
  out.words.resize(static_cast<std::size_t>(out.width) * out.height * 4);
  tiles_.pop_front();
  pixels_.on_tile(std::move(out));
}

}  // namespace fastsplat::testbench
