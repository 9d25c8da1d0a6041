// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_composite.hpp"

#include <algorithm>
#include <string>

#include "testbench/device/words.hpp"

namespace fastsplat::testbench {
namespace {

std::size_t blocks(const cmodel::Config& config) {
  return static_cast<std::size_t>((config.tile_width / config.lanes) * (config.tile_height / config.lanes));
}

}  // namespace

CompositeCoverage::Four CompositeCoverage::four(const char* group, const std::string& prefix, cmodel::Site site,
                                                std::int64_t largest) {
  Four points;
  for (std::size_t c = 0; c < 4; ++c)
    points[c] = RoundingPoint(coverage_, group, prefix + kChannels[c] + "_", sites_[site], largest);
  return points;
}

CompositeCoverage::CompositeCoverage(const cmodel::Config& config, Coverage& coverage, SplatCoverage& splats)
    : config_(config),
      coverage_(coverage),
      splats_(splats),
      columns_(static_cast<std::size_t>(config.tile_width)),
      factor_(static_cast<std::size_t>(config.opacity_segments) + 1, 0),
      sites_(config),
      picture_(columns_ * static_cast<std::size_t>(config.tile_height)),
      touched_(blocks(config)) {
  // Colours end below 2.0; the picture's alpha and, except for saturation, its colours end at 1.0.
  const std::int64_t sum = config.sheet_format().max, one = config.transmittance_format().max;
  const std::int64_t factor = config.factor_format().max;
  const std::int64_t remainder = (std::int64_t{1} << config.opacity_remainder_bits()) - 1;
  segment_first_ = coverage.declare("factor", "first_segment");
  segment_last_ = coverage.declare("factor", "last_segment");
  tau_zero_ = coverage.declare("factor", "tau_zero");
  tau_largest_ = coverage.declare("factor", "tau_largest");
  fall_ = RoundingPoint(coverage, "factor", "fall_", sites_[cmodel::Site::Fall], factor * remainder);
  exponential_ = four("slab", "exponential_", cmodel::Site::SlabColour, sum * factor);
  additive_ = four("slab", "additive_", cmodel::Site::AddedColour, sum);
  light_ = four("light", "", cmodel::Site::Light, one * one);
  colour_saturated_ = coverage.bins().size();
  for (int c = 0; c < 3; ++c) coverage.declare("picture", std::string(kChannels[c]) + "_saturated");
  colour_alone_ = coverage.bins().size();
  for (int c = 0; c < 3; ++c) coverage.declare("picture", std::string(kChannels[c]) + "_alone_saturated");
  sum_saturated_ = coverage.bins().size();
  for (const char* channel : kChannels) coverage.declare("picture", std::string("sum_") + channel + "_saturated");
  sum_alone_ = coverage.bins().size();
  for (const char* channel : kChannels) coverage.declare("picture", std::string("sum_") + channel + "_alone_saturated");
  t_one_ = coverage.declare("transmittance", "one");
  t_zero_ = coverage.declare("transmittance", "falls_to_zero");
  at_threshold_ = coverage.declare("transmittance", "at_threshold_goes_on");
  below_threshold_ = coverage.declare("transmittance", "one_below_threshold_frozen");
  crosses_ = coverage.declare("transmittance", "crosses_threshold");
  frozen_light_ = coverage.declare("transmittance", "frozen_under_light");
  block_first_ = coverage.declare("block", "first");
  block_last_ = coverage.declare("block", "last");
  block_blank_ = coverage.declare("block", "on_blank_picture");
  block_again_ = coverage.declare("block", "on_an_earlier_sheet");
  block_partial_ = coverage.declare("block", "partly_outside_the_tile");
  composited_out_ = four("pixel", "", cmodel::Site::PixelOut, one);
  sum_out_ = four("pixel", "sum_", cmodel::Site::PixelSum, sum);
  untouched_ = coverage.declare("pixel", "never_composited");
  alpha_zero_ = coverage.declare("pixel", "alpha_zero");
  alpha_one_ = coverage.declare("pixel", "alpha_one");
}

void CompositeCoverage::load(const cmodel::LoadTable& table) {
  if (table.table == cmodel::Table::Factor) factor_ = table.words;
}

cmodel::PixelState CompositeCoverage::blank() const {
  return {0, 0, 0, tile_.mode == cmodel::Mode::Sum ? 0 : std::uint32_t{1} << config_.composite_frac_bits};
}

void CompositeCoverage::begin_tile(const cmodel::BeginTile& tile) {
  tile_ = tile;
  picture_.assign(picture_.size(), blank());
  touched_.assign(touched_.size(), false);
}

void CompositeCoverage::on_tap(const cmodel::TapRecord& record) {
  if (record.tap == cmodel::Tap::Composite) cmodel::every_sample(tile_.mode) ? window(record) : block(record);
  if (record.tap == cmodel::Tap::Pixel) pixel(record);
}

void CompositeCoverage::block(const cmodel::TapRecord& record) {
  const std::size_t number = block_of(record.x, record.y);
  if (number == 0) coverage_.hit(block_first_);
  if (number + 1 == touched_.size()) coverage_.hit(block_last_);
  coverage_.hit(touched_[number] ? block_again_ : block_blank_);
  touched_[number] = true;
  if (record.x + config_.lanes > tile_.width || record.y + config_.lanes > tile_.height) coverage_.hit(block_partial_);
  std::size_t word = 0;
  for (int y = record.y; y < record.y + config_.lanes; ++y) {
    for (int x = record.x; x < record.x + config_.lanes; ++x, word += 4) {
      if (x >= tile_.width || y >= tile_.height) continue;
      cmodel::PixelState& state = picture_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
      cmodel::SheetWord& sums = splats_.sums(x, y);
      cmodel::PixelState after{};
      std::copy_n(record.payload.begin() + static_cast<std::ptrdiff_t>(word), 4, after.begin());
      pixel_step(sums, state, after);
      state = after;
      sums = {};
    }
  }
}

void CompositeCoverage::window(const cmodel::TapRecord& record) {
  std::size_t lane = 0;
  for (int y = record.y; y < record.y + config_.lanes; ++y) {
    for (int x = record.x; x < record.x + config_.lanes; ++x, ++lane) {
      if (x < 0 || y < 0 || x >= tile_.width || y >= tile_.height) continue;
      const auto sample = splats_.sample(lane);
      if (!sample) continue;
      touched_[block_of(x, y)] = true;
      cmodel::PixelState& state = picture_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
      cmodel::PixelState after{};
      std::copy_n(record.payload.begin() + static_cast<std::ptrdiff_t>(4 * lane), 4, after.begin());
      pixel_step(*sample, state, after);
      state = after;
    }
  }
}

std::size_t CompositeCoverage::block_of(int x, int y) const {
  return static_cast<std::size_t>(y / config_.lanes) * (columns_ / static_cast<std::size_t>(config_.lanes)) +
         static_cast<std::size_t>(x / config_.lanes);
}

std::array<std::int64_t, 4> CompositeCoverage::slab(const cmodel::SheetWord& sums) {
  const bool exponential = cmodel::slab_mode(tile_.mode) == cmodel::Mode::Exponential;
  std::int64_t f = 1;
  if (exponential) {
    const int rem_bits = config_.opacity_remainder_bits();
    const std::size_t segment = sums[3] >> rem_bits;
    const std::int64_t rem = sums[3] & ((std::int64_t{1} << rem_bits) - 1);
    if (segment == 0) coverage_.hit(segment_first_);
    if (segment + 2 == factor_.size()) coverage_.hit(segment_last_);
    if (sums[3] == 0) coverage_.hit(tau_zero_);
    if (sums[3] == static_cast<std::uint32_t>(config_.sheet_format().max)) coverage_.hit(tau_largest_);
    f = factor_[segment] - fall_.sample(coverage_, (std::int64_t{factor_[segment]} - factor_[segment + 1]) * rem).word;
  }
  std::array<std::int64_t, 4> out{};
  for (std::size_t c = 0; c < 4; ++c)
    out[c] = (exponential ? exponential_ : additive_)[c].sample(coverage_, sums[c] * f).word;
  return out;
}

void CompositeCoverage::pixel_step(const cmodel::SheetWord& sums, const cmodel::PixelState& before,
                                   const cmodel::PixelState& after) {
  int cut = 0;
  std::size_t last = 0;
  if (tile_.mode == cmodel::Mode::Sum) {
    for (std::size_t c = 0; c < 4; ++c) {
      if (!sites_[cmodel::Site::SumOver](std::int64_t{before[c]} + sums[c]).overflow) continue;
      coverage_.hit(sum_saturated_ + c);
      ++cut;
      last = c;
    }
    if (cut == 1) coverage_.hit(sum_alone_ + last);
    return;
  }
  const auto words = slab(sums);
  const bool lit = std::any_of(words.begin(), words.end(), [](std::int64_t word) { return word > 0; });
  transmittance(before[3], after[3], lit);
  if (before[3] < static_cast<std::uint32_t>(config_.freeze_below)) return;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::int64_t light = light_[c].sample(coverage_, before[3] * words[c]).word;
    if (c == 3 || !sites_[cmodel::Site::Over](before[c] + light).overflow) continue;
    coverage_.hit(colour_saturated_ + c);
    ++cut;
    last = c;
  }
  if (cut == 1) coverage_.hit(colour_alone_ + last);
}

void CompositeCoverage::transmittance(std::uint32_t before, std::uint32_t after, bool light) {
  const auto threshold = static_cast<std::uint32_t>(config_.freeze_below);
  if (before == std::uint32_t{1} << config_.composite_frac_bits) coverage_.hit(t_one_);
  if (before < threshold) {
    if (before + 1 == threshold) coverage_.hit(below_threshold_);
    if (light) coverage_.hit(frozen_light_);
    return;
  }
  if (before == threshold && light) coverage_.hit(at_threshold_);
  if (after < threshold && after > 0) coverage_.hit(crosses_);
  if (after == 0) coverage_.hit(t_zero_);
}

void CompositeCoverage::pixel(const cmodel::TapRecord& record) {
  const cmodel::PixelState& state =
      picture_[static_cast<std::size_t>(record.y) * columns_ + static_cast<std::size_t>(record.x)];
  const std::size_t number = block_of(record.x, record.y);
  if (!touched_[number]) coverage_.hit(untouched_);
  const bool sum = tile_.mode == cmodel::Mode::Sum;
  const std::int64_t one = std::int64_t{1} << config_.composite_frac_bits;
  for (std::size_t c = 0; c < 4; ++c) {
    if (sum)
      sum_out_[c].sample(coverage_, state[c]);
    else
      composited_out_[c].sample(coverage_, c == 3 ? one - state[c] : state[c]);
  }
  if (sum) return;
  if (state[3] == one) coverage_.hit(alpha_zero_);
  if (state[3] == 0) coverage_.hit(alpha_one_);
}

}  // namespace fastsplat::testbench
