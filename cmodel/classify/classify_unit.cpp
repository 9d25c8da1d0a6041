// SPDX-License-Identifier: Apache-2.0
#include "cmodel/classify/classify_unit.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace fastsplat::cmodel {
namespace {

using namespace classify;

std::int64_t signed_word(std::uint32_t word) { return static_cast<std::int32_t>(word); }

}  // namespace

ClassifyUnit::Lines::Lines(int frac_bits, int rest_bits)
    : rest_bits_(rest_bits), fall_(nearest(frac_bits + rest_bits, signed_format(8, frac_bits))) {}

std::int64_t ClassifyUnit::Lines::at(std::span<const std::uint32_t> words, std::int64_t position, std::size_t first,
                                     std::size_t step) const {
  const std::size_t here = static_cast<std::size_t>(position >> rest_bits_) * step + first;
  const std::int64_t rest = position & ((std::int64_t{1} << rest_bits_) - 1);
  if (rest == 0) return words[here];
  return words[here] - fall_((std::int64_t{words[here]} - words[here + step]) * rest).word;
}

ClassifyUnit::ClassifyUnit(const Config& config)
    : sheet_frac_bits_(config.sheet_frac_bits),
      top_(std::int64_t{1} << config.sheet_frac_bits),
      colour_lines_(kColour, config.classify_rest_bits()),
      tau_lines_(config.sheet_frac_bits, config.classify_rest_bits()),
      root_lines_(kRoot, kSlope - kRootBits),
      glint_lines_(kPhong, kLight - kGlintBits),
      across_(nearest(config.sheet_frac_bits + kScale, signed_format(4, kSlope))),
      along_(nearest(kSlope + kScale, signed_format(4, kSlope))),
      tilt_(nearest(kTilt, signed_format(4, kScale))),
      length_(nearest(kSlope + kRoot + kSlope, unsigned_format(5, kLength))),
      share_(nearest(kLength + kFloor, unit_format(kShare))),
      matt_(nearest(kPhong + kLight, unsigned_format(5, kPhong))),
      lit_(nearest(kColour + kPhong + kShare, unit_format(kLit))),
      product_(nearest(kLit + config.sheet_frac_bits, config.sheet_format())),
      leant_(nearest(kLength + kSlope, signed_format(pattern::kLeantInt, kSlope))),
      pattern_(config) {}

void ClassifyUnit::load(Table table, std::span<const std::uint32_t> words) {
  if (table == Table::Nodes || table == Table::Pattern) {
    pattern_.load(table, words);
    return;
  }
  std::vector<std::uint32_t>& to = table == Table::Classify   ? classify_
                                   : table == Table::Root     ? root_
                                   : table == Table::Glint    ? glint_
                                   : table == Table::Lighting ? light_
                                                              : sheets_;
  to.assign(words.begin(), words.end());
}

std::int64_t ClassifyUnit::tilt(std::size_t axis, std::int32_t pixel) const {
  const std::size_t at = kTilts + 2 * axis;
  return tilt_(signed_word(light_[at]) + signed_word(light_[at + 1]) * pixel).word;
}

std::int64_t ClassifyUnit::facing(const Normal& normal, std::size_t vector) const {
  std::int64_t along = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    along += normal.g[axis] * signed_word(light_[kVectors + 3 * vector + axis]);
  return nearest(2 * kLight + normal.half_shift, unit_format(kLight))(std::abs(along) * normal.root).word;
}

bool ClassifyUnit::measure(Normal& normal) const {
  std::int64_t square = 0;
  for (const std::int64_t g : normal.g) square += g * g;
  if (square == 0) return false;
  const int even = (std::bit_width(static_cast<std::uint64_t>(square)) - 1) & ~1;
  normal.m = even >= kSlope ? square >> (even - kSlope) : square << (kSlope - even);
  normal.half_shift = even / 2;
  normal.root = root_lines_.at(root_, normal.m - (std::int64_t{1} << kSlope));
  return true;
}

std::int64_t ClassifyUnit::length(const Normal& normal) const {
  return length_(normal.m * normal.root * (std::int64_t{1} << normal.half_shift)).word;
}

void ClassifyUnit::lean(Normal& normal, const std::array<std::int64_t, 3>& by) const {
  std::int64_t dot = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) dot += normal.g[axis] * by[axis];
  const Narrowing along =
      nearest(pattern::kAmount + kRoot + normal.half_shift, signed_format(pattern::kAmountInt, pattern::kAmount));
  const std::int64_t p = along(dot * normal.root).word, l = length(normal);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t g = normal.g[axis];
    normal.g[axis] = leant_((g << kLength) + l * by[axis] - p * g * (std::int64_t{1} << (kLength - kSlope))).word;
  }
}

SheetWord ClassifyUnit::operator()(std::uint32_t density, const DensitySlope& slope, std::int32_t x, std::int32_t y,
                                   std::uint32_t sheet) const {
  const std::int64_t value = std::min<std::int64_t>(density, top_);
  const std::int64_t tau = tau_lines_.at(classify_, value, 3, 4);
  if (tau == 0) return {};
  std::array<std::int64_t, 3> colour;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = colour_lines_.at(classify_, value, c, 4);
  PatternUnit::Sample solid{};
  if (pattern_.loaded()) {
    solid = pattern_({.x = x, .y = y, .sheet = sheet});
    for (std::size_t c = 0; c < 3; ++c) colour[c] = pattern_.tinted(colour[c], solid.tint[c]);
  }

  const std::uint32_t scales = sheets_[kSheetWords * sheet];
  const std::int64_t scale = scales & 0xFFFFU, depth_scale = scales >> 16, per_floor = sheets_[kSheetWords * sheet + 1];
  Normal normal{};
  normal.g[0] = across_(slope.x * scale).word;
  normal.g[1] = across_(slope.y * scale).word;
  normal.g[2] = along_(slope.z * depth_scale * (std::int64_t{1} << (kSlope - sheet_frac_bits_)) -
                       tilt(0, x) * normal.g[0] - tilt(1, y) * normal.g[1])
                    .word;
  bool steep = measure(normal);
  if (steep && pattern_.loaded()) {
    lean(normal, solid.lean);
    steep = measure(normal);
  }

  std::int64_t share = 0, matt = 0, glint = 0;
  if (steep) {
    share = share_(length(normal) * per_floor - (std::int64_t{1} << (kLength + kFloor))).word;
    matt = matt_((std::int64_t{light_[kAmbient]} << kLight) + std::int64_t{light_[kDiffuse]} * facing(normal, 0)).word;
    glint = glint_lines_.at(glint_, facing(normal, 1)) * light_[kSpecular];
  }
  SheetWord out;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int64_t plain = colour[c] << kPhong;
    const std::int64_t shaded = colour[c] * matt + (glint << (kColour - kPhong));
    const std::int64_t lit = lit_((plain << kShare) + share * (shaded - plain)).word;
    out[c] = static_cast<std::uint32_t>(product_(lit * tau).word);
  }
  out[3] = static_cast<std::uint32_t>(tau);
  return out;
}

}  // namespace fastsplat::cmodel
