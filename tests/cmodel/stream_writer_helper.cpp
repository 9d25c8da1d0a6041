// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

void store(std::uint8_t* at, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(word >> (8 * i));
}
std::uint32_t pair(std::uint32_t low, std::uint32_t high) { return (low & 0xFFFF) | (high << 16); }
std::uint32_t bits(std::int32_t value) { return static_cast<std::uint32_t>(value); }

}  // namespace

void StreamWriter::beat(const cmodel::Beat& words) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + cmodel::kBeatBytes);
  for (std::size_t i = 0; i < words.size(); ++i) store(&bytes_[at + 4 * i], words[i]);
}

void StreamWriter::begin_frame(int width, int height, std::uint32_t tiles) {
  const std::uint64_t hash = oracle::hash(symbols_);
  beat({pair(0x46, 2), 0x31535346, static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32),
        pair(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)), tiles});
}

void StreamWriter::load_table(int table, std::uint32_t set, std::uint32_t rho, std::uint32_t base,
                              const std::vector<std::uint32_t>& words) {
  beat({0x4C | static_cast<std::uint32_t>(table) << 8, set, rho, static_cast<std::uint32_t>(words.size()), base, 0});
  for (std::size_t i = 0; i < words.size(); i += cmodel::kBeatWords) {
    cmodel::Beat some{};
    for (std::size_t j = i; j < i + some.size() && j < words.size(); ++j) some[j - i] = words[j];
    beat(some);
  }
}

void StreamWriter::begin_tile(int mode, std::uint32_t tile, int x, int y, int width, int height) {
  tile_ = tile;
  tag_ = sheets_ = 0;
  beat({0x54 | static_cast<std::uint32_t>(mode) << 8, tile, bits(x), bits(y),
        pair(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)), 0});
}

void StreamWriter::begin_sheet(std::uint32_t sheet) {
  sheet_ = sheet;
  splats_ = 0;
  ++sheets_;
  beat({0x53, sheet, 0, 0, 0, 0});
}

void StreamWriter::splat(int set, std::int32_t x, std::int32_t y, const std::array<std::uint32_t, 4>& colour) {
  beat({0x50 | static_cast<std::uint32_t>(set) << 8, tag_++, bits(x), bits(y), pair(colour[0], colour[1]),
        pair(colour[2], colour[3])});
  ++splats_;
  ++total_splats_;
}

void StreamWriter::ellipse(const oracle::Ellipse& e) {
  const auto field = [](std::int64_t value, int first, int n) {
    return (static_cast<std::uint32_t>(value) & ((std::uint32_t{1} << n) - 1)) << first;
  };
  beat({0x45 | field(e.B, 8, 24), tag_++, field(e.x, 0, 22) | field(e.nx - 1, 22, 5) | field(e.ny - 1, 27, 5),
        field(e.y, 0, 22) | field(e.h, 22, 6), pair(e.v[0], e.v[1]), pair(e.v[2], e.v[3]),
        field(e.A, 0, 22) | field(e.left, 22, 10), field(e.C, 0, 22) | field(e.top, 22, 10)});
  ++splats_;
  ++total_splats_;
}

void StreamWriter::cull_block(std::uint32_t tag, std::int32_t x, std::int32_t y, int width, int height,
                              std::uint32_t splats) {
  beat({0x43, tag, bits(x), bits(y), pair(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)),
        splats});
}

void StreamWriter::end_sheet() { beat({0x73, sheet_, splats_, 0, 0, 0}); }
void StreamWriter::end_tile() { beat({0x74, tile_, sheets_, 0, 0, 0}); }

void StreamWriter::end_frame() {
  beat({0x66, 0, 0, 0, 0, 0});
  seal(bytes_);
}

std::vector<cmodel::Beat> to_beats(std::span<const std::uint8_t> bytes) {
  std::vector<cmodel::Beat> beats(bytes.size() / cmodel::kBeatBytes);
  for (std::size_t i = 0; i < beats.size(); ++i)
    for (std::size_t j = 0; j < cmodel::kBeatWords; ++j) {
      const std::uint8_t* at = &bytes[i * cmodel::kBeatBytes + j * 4];
      beats[i][j] =
          std::uint32_t{at[0]} | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16 | std::uint32_t{at[3]} << 24;
    }
  return beats;
}

std::size_t first_tile_beat(std::span<const std::uint8_t> bytes) {
  std::size_t beat = 1;
  while (bytes[beat * cmodel::kBeatBytes] == 0x4C) {
    const std::uint8_t* count = &bytes[beat * cmodel::kBeatBytes + 12];
    beat += 1 + (count[0] + 256U * count[1] + 65536U * count[2] + cmodel::kBeatWords - 1) / cmodel::kBeatWords;
  }
  return beat;
}

void seal(std::vector<std::uint8_t>& bytes) {
  const std::size_t at = bytes.size() - cmodel::kBeatBytes;
  const std::uint64_t before = at / cmodel::kBeatBytes;
  store(&bytes[at + 4], static_cast<std::uint32_t>(before));
  store(&bytes[at + 8], static_cast<std::uint32_t>(before >> 32));
  store(&bytes[at + 12], oracle::crc32(std::span(bytes).first(at)));
}

}  // namespace fastsplat::test
