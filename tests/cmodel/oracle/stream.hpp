// SPDX-License-Identifier: Apache-2.0
// Reads a stream from its bytes by docs/stream.md alone, and refuses illegal ones.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "tests/cmodel/oracle/ellipse.hpp"
#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::oracle {

/// The stream breaks a rule; beat is the first one that shows it (the number of beats if the end is missing).
struct Refusal : std::runtime_error {
  Refusal(std::uint64_t at, const std::string& rule) : std::runtime_error(rule), beat(at) {}
  std::uint64_t beat;
};

struct TableLoad {
  int table = 0;  ///< 0 RLUT, 1 RADIAL, 2 FACTOR, 3 to 7 those of densities, 8 and 9 of patterns
  std::int64_t set = 0, rho = 0, base = 0, Ea = 0;
  std::vector<std::uint32_t> words;
};
struct TileStart {
  int mode = 0;
  std::uint32_t tile = 0;
  std::int32_t x = 0, y = 0;
  int width = 0, height = 0;
  int image_width = 0, image_height = 0;
};
struct SheetStart {
  std::uint32_t sheet = 0;
};
struct Splat {
  int set = 0;
  std::uint32_t tag = 0;
  std::int32_t x = 0, y = 0;
  std::uint32_t v[4] = {};
};
struct CullHint {
  std::int32_t x = 0, y = 0;
  int width = 0, height = 0;
  std::uint32_t splats = 0;
};
struct SheetEnd {};
struct TileEnd {};
using Item = std::variant<TableLoad, TileStart, SheetStart, Splat, Ellipse, CullHint, SheetEnd, TileEnd>;

/// A whole stream; throws Refusal.
std::vector<Item> read_stream(const Symbols& symbols, std::span<const std::uint8_t> bytes);

}  // namespace fastsplat::oracle
