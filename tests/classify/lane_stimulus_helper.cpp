// SPDX-License-Identifier: Apache-2.0
#include <iterator>

#include "tests/classify/lane_bench_helper.hpp"

namespace fastsplat::test {

using cmodel::Table;
namespace classify = cmodel::classify;

namespace {

/// Tables of one value each, for which a rounding lies exactly on its edge: one more part of a word changes the result.
struct Edge {
  double slope;  ///< gx, S 4.16 words
  std::uint32_t root, per_floor, colour, ambient, glint, specular;
};
constexpr Edge kEdges[] = {
    {1, 448, 614765129, 16384, 0, 0, 0},       // length 7: the share is just below 1 of 256
    {1 << 15, 16384, 513, 16384, 0, 0, 0},     // length 2^23: it is just 1
    {1 << 15, 16384, 522, 1, 4099, 4, 21299},  // a lit colour just below the half
};

}  // namespace

/// gx = dx scale 2^(4 - sf); tau is 1.0.
void LaneStimulus::edge_tables(int which) {
  const Edge& edge = kEdges[which];
  const auto one = std::uint32_t{1} << config_.sheet_frac_bits;
  for (std::size_t i = 0; i < classify_.size(); ++i) classify_[i] = i % 4 == 3 ? one : edge.colour;
  std::ranges::fill(root_, edge.root);
  std::ranges::fill(glint_, edge.glint);
  std::ranges::fill(lighting_, 0U);
  lighting_[classify::kAmbient] = edge.ambient;
  lighting_[classify::kSpecular] = edge.specular;
  const double product = std::ldexp(edge.slope, config_.sheet_frac_bits - 4);
  const double scale = std::min(product, std::ldexp(1.0, classify::kScale));
  rise_ = static_cast<std::uint32_t>(product / scale);
  sheets_ = {static_cast<std::uint32_t>(scale), edge.per_floor};
  width_ = height_ = 65535;
}

void LaneStimulus::next_tables() {
  const auto words = [&](Table table) { return testbench::random_density_table(config_, random_, table).words; };
  classify_ = words(Table::Classify);
  root_ = words(Table::Root);
  glint_ = words(Table::Glint);
  lighting_ = words(Table::Lighting);
  // ROOT holds square roots in most sets, so lengths are true lengths.
  if (random_.chance(70)) {
    for (std::size_t i = 0; i < root_.size(); ++i)
      root_[i] = static_cast<std::uint32_t>(std::lround(std::ldexp(
          1.0 / std::sqrt(1.0 + std::ldexp(static_cast<double>(i), -classify::kRootBits)), classify::kRoot)));
  }
  // Half of the pixels have no tilt, so the length is that of the differences.
  const bool straight = random_.chance(50);
  if (straight) std::fill(lighting_.begin() + classify::kTilts, lighting_.end(), 0U);
  // Neighbours differ by a step whose slope is near the gradient floor: the share of shading is between 0 and 1.
  step_ = config_.sheet_format().max >> random_.between(0, 12);
  const std::int64_t scale = random_.between(1, std::int64_t{1} << random_.between(1, classify::kScale));
  const std::int64_t along = random_.chance(30) ? 0 : random_.between(0, std::int64_t{1} << classify::kScale);
  const double slope = std::ldexp(static_cast<double>(step_) * static_cast<double>(scale),
                                  classify::kLength - classify::kScale - config_.sheet_frac_bits);
  const double most = 4294967295.0;
  const double floor =
      std::ldexp(1.0 + static_cast<double>(random_.between(0, 4096)) / 1024.0, classify::kLength + classify::kFloor) /
      std::max(slope, 1.0);
  sheets_ = {static_cast<std::uint32_t>(scale | along << 16), random_.chance(80)
                                                                  ? static_cast<std::uint32_t>(std::min(floor, most))
                                                                  : static_cast<std::uint32_t>(random_.next())};
  width_ = static_cast<std::int32_t>(random_.between(1, random_.chance(50) ? 8 : 65535));
  height_ = static_cast<std::int32_t>(random_.between(1, random_.chance(50) ? 8 : 65535));
  rise_.reset();
  if (sets_++ % 16 == 15) edge_tables(sets_ / 16 % static_cast<int>(std::size(kEdges)));
  unit_.emplace(config_);
  unit_->load(Table::Classify, classify_);
  unit_->load(Table::Root, root_);
  unit_->load(Table::Glint, glint_);
  unit_->load(Table::Lighting, lighting_);
  unit_->load(Table::Sheets, sheets_);
}

std::uint32_t LaneStimulus::near(std::uint32_t word) {
  const std::int64_t most = config_.sheet_format().max;
  if (random_.chance(5)) return static_cast<std::uint32_t>(random_.between(0, most));
  return static_cast<std::uint32_t>(
      std::clamp(std::int64_t{word} + random_.between(-step_, step_), std::int64_t{0}, most));
}

LanePixel LaneStimulus::pixel() {
  LanePixel out;
  // 1.0 is the end of the last segment, and few sheets hold more.
  out.here = static_cast<std::uint32_t>(
      random_.between(0, random_.chance(90) ? std::int64_t{1} << config_.sheet_frac_bits : config_.sheet_format().max));
  for (std::uint32_t* word : {&out.left, &out.right, &out.above, &out.below, &out.before, &out.behind})
    *word = near(out.here);
  // Sometimes no slope.
  if (random_.chance(2)) out.left = out.right = out.above = out.below = out.before = out.behind = out.here;
  const auto place = [&](std::int32_t side) {
    if (random_.chance(10)) return random_.chance(50) ? 0 : side - 1;
    return static_cast<std::int32_t>(random_.between(0, side - 1));
  };
  out.x = place(width_);
  out.y = place(height_);
  if (rise_) {
    out.above = out.below = out.before = out.behind = out.here;
    out.left = 0;
    out.right = *rise_;
    out.x = out.y = 1;
  }
  return out;
}

cmodel::SheetWord LaneStimulus::expected(const LanePixel& pixel) const {
  // As in cmodel/classify/density_stage.hpp: one-sided at the picture's edges, counted twice.
  const auto difference = [&](std::uint32_t after, std::uint32_t before, std::int32_t at, std::int32_t side) {
    const bool first = at == 0, last = at == side - 1;
    const std::int64_t all = std::int64_t{last ? pixel.here : after} - std::int64_t{first ? pixel.here : before};
    return first || last ? 2 * all : all;
  };
  return (*unit_)(pixel.here,
                  {.x = difference(pixel.right, pixel.left, pixel.x, width_),
                   .y = difference(pixel.below, pixel.above, pixel.y, height_),
                   .z = std::int64_t{pixel.behind} - std::int64_t{pixel.before}},
                  pixel.x, pixel.y, 0);
}

std::vector<std::uint32_t> LaneStimulus::entries(Table table, int channel) const {
  if (table != Table::Classify) return table == Table::Root ? root_ : glint_;
  std::vector<std::uint32_t> out;
  for (std::size_t i = static_cast<std::size_t>(channel); i < classify_.size(); i += 4) out.push_back(classify_[i]);
  return out;
}

}  // namespace fastsplat::test
