// SPDX-License-Identifier: Apache-2.0
#include "cmodel/classify/pattern_unit.hpp"

#include <algorithm>

#include "cmodel/classify/classify_tables.hpp"

namespace fastsplat::cmodel {
namespace {

using namespace pattern;

using classify::nearest;

/// Places 0 .. M-1 among the nodes (N-6.3-4).
Format place_format(const Config& config) {
  return {0, ((std::int64_t{1} << config.pattern_node_bits) - 1) << kPlace, kPlace, 0};
}

std::int64_t low_half(std::uint32_t word) { return static_cast<std::int16_t>(word & 0xFFFFU); }
std::int64_t high_half(std::uint32_t word) { return static_cast<std::int16_t>(word >> 16); }

}  // namespace

PatternUnit::PatternUnit(const Config& config)
    : node_bits_(config.pattern_node_bits),
      place_(nearest(kStep, place_format(config))),
      line_(nearest(kValue + kPlace, signed_format(2, kValue))),
      tint_(nearest(kTint + kValue, signed_format(2, kTint))),
      lean_(nearest(kLean + kAmount, signed_format(kAmountInt, kAmount))),
      colour_(nearest(classify::kColour + kTint, unit_format(classify::kColour))),
      sum_(nearest(config.sheet_frac_bits + kTint, config.sheet_format())) {}

void PatternUnit::load(Table table, std::span<const std::uint32_t> words) {
  if (table == Table::Nodes)
    nodes_ = std::make_shared<const std::vector<std::uint32_t>>(words.begin(), words.end());
  else
    words_.assign(words.begin(), words.end());
}

PatternUnit::Node PatternUnit::node(std::size_t number) const {
  const std::uint32_t* words = nodes_->data() + kNodeWords * number;
  return {std::int64_t{words[0] & 0xFFFFU}, high_half(words[0]), low_half(words[1]), high_half(words[1])};
}

PatternUnit::Node PatternUnit::line(const Node& a, const Node& b, std::int64_t rest) const {
  Node out;
  for (std::size_t c = 0; c < out.size(); ++c) out[c] = a[c] + line_((b[c] - a[c]) * rest).word;
  return out;
}

PatternUnit::Node PatternUnit::between(const Pixel& pixel) const {
  const std::array<std::int64_t, 3> at{pixel.x, pixel.y, pixel.sheet};
  std::size_t number = 0;
  std::array<std::size_t, 3> next{};  // step to the next node along each axis; 0 if it is not read
  std::array<std::int64_t, 3> rest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t away = std::clamp<std::int64_t>(at[axis] - words_[kPlaces + axis], 0, kFar);
    const std::int64_t place = place_(away * words_[kSteps + axis]).word;
    rest[axis] = place & ((std::int64_t{1} << kPlace) - 1);
    const std::size_t step = std::size_t{1} << (axis * static_cast<std::size_t>(node_bits_));
    number += static_cast<std::size_t>(place >> kPlace) * step;
    if (rest[axis] != 0) next[axis] = step;
  }
  const auto row = [&](std::size_t first) { return line(node(first), node(first + next[0]), rest[0]); };
  const auto plane = [&](std::size_t first) { return line(row(first), row(first + next[1]), rest[1]); };
  return line(plane(number), plane(number + next[2]), rest[2]);
}

std::array<std::int64_t, 3> PatternUnit::tint(std::int64_t value) const {
  std::array<std::int64_t, 3> out;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::int64_t low = words_[kLow + c];
    out[c] = low + tint_((words_[kHigh + c] - low) * value).word;
  }
  return out;
}

PatternUnit::Sample PatternUnit::operator()(const Pixel& pixel) const {
  const Node at = between(pixel);
  Sample out{.tint = tint(at[0]), .lean = {}};
  for (std::size_t c = 0; c < 3; ++c) out.lean[c] = lean_(at[c + 1] * words_[kA]).word;
  return out;
}

SheetWord PatternUnit::tinted(const SheetWord& sums, const Pixel& pixel) const {
  if ((sums[0] | sums[1] | sums[2]) == 0) return sums;
  const std::array<std::int64_t, 3> by = tint(between(pixel)[0]);
  SheetWord out = sums;
  for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint32_t>(sum_(std::int64_t{sums[c]} * by[c]).word);
  return out;
}

}  // namespace fastsplat::cmodel
