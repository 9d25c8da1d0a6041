// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/weight_steps.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "cmodel/splat/linear_unit.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::stages {
namespace {

using cmodel::IndexKind;

/// p / 2^shift, with an exact integer part.
double shifted(std::uint64_t product, std::uint32_t shift) {
  const auto whole = static_cast<double>(product >> shift);
  const double rest =
      std::ldexp(static_cast<double>(product & ((std::uint64_t{1} << shift) - 1)), -static_cast<int>(shift));
  return std::min(whole + rest, std::nextafter(whole + 1.0, 0.0));
}

bool is_whole(double value) { return std::floor(value) == value; }

}  // namespace

WeightSteps::WeightSteps(const scene::Kernel& kernel, const cmodel::Config& config)
    : kernel_(kernel),
      config_(config),
      rlut_(driver::target(driver::Site::Rlut, config)),
      axis_(driver::target(driver::Site::Axis, config)),
      footprint_(driver::target(driver::Site::Footprint, config)),
      axis_product_(cmodel::narrowing(config, cmodel::Site::AxisProduct)),
      radial_fall_(cmodel::narrowing(config, cmodel::Site::RadialFall)),
      grid_(config.grid()),
      entries_(config.radial_entries),
      per_entry_(std::ldexp(1.0, -config.rlut_guard_bits)),
      fall_(kernel.a() * kernel.radius() * kernel.radius()),
      real_(driver::radial_samples(config, kernel)),
      ellipse_(config) {
  for (const std::uint32_t word : driver::radial_table(config, kernel).words)
    words_.push_back(std::ldexp(static_cast<double>(word), -config.radial_frac_bits));
}

void WeightSteps::distances(double centre, double radius, int first, int end, bool words,
                            std::vector<double>& out) const {
  out.clear();
  for (int i = first; i < end; ++i) {
    const double d = i - centre;
    out.push_back(words ? driver::rlut_word(d * grid_, radius * grid_, rlut_) * per_entry_
                        : d * d * entries_ / (radius * radius));
  }
}

double WeightSteps::interpolated(double entries, const Mixture& mixture) const {
  const auto t = static_cast<std::size_t>(entries);
  // Bits below a guard step are cut off. This is exact in a double, and so is the line between the words.
  const double steps = std::floor((entries - static_cast<double>(t)) / per_entry_);
  const double line = real_[t] - (real_[t] - real_[t + 1]) * (steps * per_entry_);
  const double fall = std::ldexp((words_[t] - words_[t + 1]) * steps, config_.radial_frac_bits);
  const double word =
      words_[t] - std::ldexp(static_cast<double>(radial_fall_(std::llround(fall)).word), -config_.radial_frac_bits);
  const RoundToFloat& narrow = mixture.rounding(Step::Weight);
  if (mixture.device(Step::Index)) return mixture.device(Step::Weight) ? word : narrow(line);
  const double real = std::exp(-fall_ * (entries / entries_));
  return mixture.device(Step::Weight) ? std::max(0.0, real + (word - line)) : narrow(real);
}

double WeightSteps::weight(double entries, const Mixture& mixture) const {
  if (config_.interpolates()) return interpolated(entries, mixture);
  const auto t = static_cast<std::size_t>(entries);
  const RoundToFloat& narrow = mixture.rounding(Step::Weight);
  if (mixture.device(Step::Index)) return mixture.device(Step::Weight) ? words_[t] : narrow(real_[t]);
  // Adds the word's error to the real weight.
  const double part = entries / entries_, u = config_.index() == IndexKind::Linear ? part * part : part;
  const double real = std::exp(-fall_ * u);
  return mixture.device(Step::Weight) ? std::max(0.0, real + (words_[t] - real_[t])) : narrow(real);
}

double WeightSteps::computed(double dx, double dy, const Rim& rim, bool device) const {
  const double squared = dx * dx + dy * dy;
  const bool linear = config_.index() == IndexKind::Linear;
  if (!device)
    return linear ? std::sqrt(squared) * entries_ / rim.radius : squared * entries_ / (rim.radius * rim.radius);
  const double steps = squared * grid_ * grid_, c = rim.scale.c;  // D, 1/K pixel squared
  const auto h = rim.scale.h;
  if (!linear) {
    return is_whole(steps) ? shifted(static_cast<std::uint64_t>(steps) * rim.scale.c, h)
                           : std::ldexp(c * steps, -static_cast<int>(h));
  }
  const int g = config_.rlut_guard_bits;
  return shifted((is_whole(steps) ? cmodel::linear_distance(static_cast<std::int64_t>(steps), g)
                                  : static_cast<std::uint64_t>(std::sqrt(std::ldexp(steps, 2 * g)))) *
                     rim.scale.c,
                 h);
}

double WeightSteps::other_weight(double dx, double dy, const Rim& rim, const Mixture& mixture) const {
  const bool word = mixture.device(Step::Weight);
  switch (config_.index()) {
    case IndexKind::Linear:
    case IndexKind::Squared:
    case IndexKind::SquaredElliptic: {
      const double entries = computed(dx, dy, rim, mixture.device(Step::Distance));
      return entries < entries_ ? weight(entries, mixture) : 0.0;
    }
    case IndexKind::Blit2d:
      if (word) {
        const double squared = (dx * grid_) * (dx * grid_) + (dy * grid_) * (dy * grid_);
        return driver::footprint_word(kernel_, squared, rim.radius * grid_, footprint_) / footprint_.scale;
      }
      break;
    case IndexKind::Separable:
      if (word) {
        const auto along = [&](double d) {
          return std::int64_t{driver::axis_word(kernel_, d * grid_, rim.radius * grid_, axis_)};
        };
        return std::ldexp(static_cast<double>(axis_product_(along(dx) * along(dy)).word), -config_.radial_frac_bits);
      }
      break;
    case IndexKind::Rlut:
      break;
  }
  const double u = (dx * dx + dy * dy) / (rim.radius * rim.radius);
  return u < 1.0 ? mixture.rounding(Step::Weight)(std::exp(-fall_ * u)) : 0.0;
}

void WeightSteps::rasterise_golden(const StagedSplat& splat, const StagedShape* shape, golden::Rows rows, int width) {
  golden::ProjectedSplat p;
  const double per_unit = splat.radius / kernel_.radius();
  p.x = splat.x;
  p.y = splat.y;
  p.shape = shape != nullptr ? shape->screen : scene::ScreenShape{per_unit * per_unit, 0.0, per_unit * per_unit};
  p.reach_x = kernel_.radius() * std::sqrt(p.shape.xx);
  p.reach_y = kernel_.radius() * std::sqrt(p.shape.yy);
  golden_.rasterise(kernel_, p, rows, width);
  spans_ = golden_.spans();
  if (!spans_.empty()) weights_ = golden_.weights(spans_.front()) - spans_.front().weights;
}

void WeightSteps::rasterise_rlut(const StagedSplat& splat, const Mixture& mixture, const driver::Extent& box) {
  const bool words = mixture.device(Step::Distance);
  distances(splat.x, splat.radius, box.x0, box.x1, words, across_);
  distances(splat.y, splat.radius, box.y0, box.y1, words, down_);
  for (int y = box.y0; y < box.y1; ++y) {
    const double row = down_[static_cast<std::size_t>(y - box.y0)];
    add_row(
        y, box.x0, box.x1 - box.x0, [&](int i) { return row + across_[static_cast<std::size_t>(i)]; }, mixture);
  }
}

void WeightSteps::rasterise_ellipse(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture,
                                    golden::Rows rows, int width) {
  ellipse_.rows(splat, shape, mixture, rows, width, [&](int y, int x, std::span<const double> entries) {
    add_row(
        y, x, static_cast<int>(entries.size()), [&](int i) { return entries[static_cast<std::size_t>(i)]; }, mixture);
  });
}

double WeightSteps::float_weight(double u, const Mixture& mixture) const {
  if (!mixture.device(Step::Index) && !mixture.device(Step::Weight))
    return mixture.rounding(Step::Weight)(std::exp(-fall_ * u));
  return weight(entries_ * (config_.index() == IndexKind::Linear ? std::sqrt(u) : u), mixture);
}

template <class Square>
void WeightSteps::add_float_row(int y, int x, int x_end, const Mixture& mixture, Square square) {
  squares_.clear();
  for (int i = x; i < x_end; ++i) squares_.push_back(square(i - x));
  const auto count = static_cast<int>(squares_.size());
  const auto inside = [&](int i) { return squares_[static_cast<std::size_t>(i)] < 1.0; };  // not if it is NaN
  int begin = 0, end = count;
  while (begin < end && !inside(begin)) ++begin;
  while (begin < end && !inside(end - 1)) --end;
  if (begin == end) return;
  if (followed_x_ && *followed_x_ >= x + begin && *followed_x_ < x + end)
    followed_entries_ = entries_ * squares_[static_cast<std::size_t>(*followed_x_ - x)];
  spans_.push_back({y, x + begin, end - begin, own_.size()});
  for (int i = begin; i < end; ++i)
    own_.push_back(inside(i) ? float_weight(squares_[static_cast<std::size_t>(i)], mixture) : 0.0);
}

void WeightSteps::rasterise_floats(const StagedSplat& splat, const Mixture& mixture, const driver::Extent& box) {
  const RoundToFloat& narrow = mixture.rounding(Step::Distance);
  const double per_square = mixture.rounding(Step::Radius)(1.0 / (splat.radius * splat.radius));
  float_offsets(splat.x, box.x0, box.x1, config_.tile_width, mixture, offsets_[0]);
  float_offsets(splat.y, box.y0, box.y1, config_.tile_height, mixture, offsets_[1]);
  for (int y = box.y0; y < box.y1; ++y) {
    const double down = offsets_[1][static_cast<std::size_t>(y - box.y0)].squared;
    add_float_row(y, box.x0, box.x1, mixture, [&](int i) {
      return narrow(narrow(offsets_[0][static_cast<std::size_t>(i)].squared + down) * per_square);
    });
  }
}

void WeightSteps::rasterise_floats(const StagedSplat& splat, const StagedShape& shape, const Mixture& mixture,
                                   const driver::Extent& box) {
  const RoundToFloat& narrow = mixture.rounding(Step::Distance);
  float_offsets(splat.x, box.x0, box.x1, config_.tile_width, mixture, offsets_[0]);
  float_offsets(splat.y, box.y0, box.y1, config_.tile_height, mixture, offsets_[1]);
  for (int y = box.y0; y < box.y1; ++y) {
    const FloatOffset& down = offsets_[1][static_cast<std::size_t>(y - box.y0)];
    const double of_row = narrow(shape.unit[2] * down.squared);
    add_float_row(y, box.x0, box.x1, mixture, [&](int i) {
      const FloatOffset& across = offsets_[0][static_cast<std::size_t>(i)];
      const double mixed = narrow(shape.unit[1] * narrow(across.distance * down.distance));
      return std::max(narrow(narrow(narrow(shape.unit[0] * across.squared) + mixed) + of_row), 0.0);
    });
  }
}

template <class Entries>
void WeightSteps::add_row(int y, int x, int count, Entries entries, const Mixture& mixture) {
  int begin = 0, end = count;
  while (begin < end && !(entries(begin) < entries_)) ++begin;
  while (begin < end && !(entries(end - 1) < entries_)) --end;
  if (begin == end) return;
  if (followed_x_ && *followed_x_ >= x + begin && *followed_x_ < x + end) followed_entries_ = entries(*followed_x_ - x);
  spans_.push_back({y, x + begin, end - begin, own_.size()});
  for (int i = begin; i < end; ++i) own_.push_back(weight(entries(i), mixture));
}

void WeightSteps::rasterise_other(const StagedSplat& splat, const Mixture& mixture, const driver::Extent& box) {
  if (rim_.radius != splat.radius) {
    rim_ = {splat.radius, {}};
    if (!config_.has_phases()) {  // linear: c, h; the others: A, .., h, and A is the circle's c
      const auto words = driver::set_table(config_, kernel_, 0, splat.radius, 0).words;
      rim_.scale = {words.front(), words.back()};
    }
  }
  for (int y = box.y0; y < box.y1; ++y) {
    const std::size_t first = own_.size();
    int begin = box.x1, end = box.x0;
    for (int x = box.x0; x < box.x1; ++x) {
      own_.push_back(other_weight(x - splat.x, y - splat.y, rim_, mixture));
      if (followed_x_ == x && config_.index() != IndexKind::Blit2d && config_.index() != IndexKind::Separable)
        followed_entries_ = computed(x - splat.x, y - splat.y, rim_, mixture.device(Step::Distance));
      if (own_.back() > 0.0) begin = std::min(begin, x), end = x + 1;
    }
    if (begin < end) spans_.push_back({y, begin, end - begin, first + static_cast<std::size_t>(begin - box.x0)});
  }
}

void WeightSteps::rasterise(const StagedSplat& splat, const StagedShape* shape, const Mixture& mixture,
                            bool golden_units, golden::Rows rows, int width) {
  if (golden_units) return rasterise_golden(splat, shape, rows, width);
  spans_.clear();
  own_.clear();
  followed_entries_.reset();
  if (shape != nullptr && shape->own && float_distances(mixture)) {
    rasterise_floats(splat, *shape, mixture,
                     pixels_about(splat.x, splat.y, shape->reach_x, shape->reach_y, rows, width));
  } else if (shape != nullptr && shape->own) {
    rasterise_ellipse(splat, *shape, mixture, rows, width);
  } else {
    rasterise_circle(splat, mixture, rows, width);
  }
  weights_ = own_.data();
}

std::optional<WeightSteps::Followed> WeightSteps::followed() const {
  for (const auto& span : spans_) {
    if (*followed_x_ >= span.x && *followed_x_ < span.x + span.width)
      return Followed{followed_entries_, weights(span)[static_cast<std::size_t>(*followed_x_ - span.x)]};
  }
  return std::nullopt;
}

void WeightSteps::rasterise_circle(const StagedSplat& splat, const Mixture& mixture, golden::Rows rows, int width) {
  const double reach = splat.radius + more_reach(config_);
  const driver::Extent box = pixels_about(splat.x, splat.y, reach, reach, rows, width);
  const bool of_offsets = config_.index() == IndexKind::Blit2d || config_.index() == IndexKind::Separable;
  if (float_distances(mixture) && !(of_offsets && mixture.device(Step::Weight))) {
    rasterise_floats(splat, mixture, box);
  } else if (config_.index() == IndexKind::Rlut) {
    rasterise_rlut(splat, mixture, box);
  } else {
    rasterise_other(splat, mixture, box);
  }
}

}  // namespace fastsplat::stages
