#include "stages/weight_steps.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "driver/tables.hpp"

namespace fastsplat::stages {

WeightSteps::WeightSteps(const scene::Kernel& kernel, const cmodel::Config& config)
    : kernel_(kernel),
      rlut_(driver::target(driver::Site::Rlut, config)),
      phases_(config.phases),
      entries_(config.radial_entries),
      per_entry_(std::ldexp(1.0, -config.rlut_guard_bits)),
      fall_(kernel.a() * kernel.radius() * kernel.radius() / entries_),
      real_(driver::radial_samples(config, kernel)) {
  for (const std::uint32_t word : driver::radial_table(config, kernel).words)
    words_.push_back(std::ldexp(static_cast<double>(word), -config.radial_frac_bits));
}

void WeightSteps::distances(double centre, double radius, int first, int pixels, bool words,
                            std::vector<double>& out) const {
  out.clear();
  for (int i = 0; i < pixels; ++i) {
    const double d = first + i - centre;
    out.push_back(words ? driver::rlut_word(d * phases_, radius * phases_, rlut_) * per_entry_
                        : d * d * entries_ / (radius * radius));
  }
}

double WeightSteps::weight(double entries, const Mixture& mixture) const {
  const auto t = static_cast<std::size_t>(entries);
  if (mixture.device(Step::Index)) return mixture.device(Step::Weight) ? words_[t] : real_[t];
  // The word's own error, at the place where the real weight is read.
  const double real = std::exp(-fall_ * entries);
  return mixture.device(Step::Weight) ? std::max(0.0, real + (words_[t] - real_[t])) : real;
}

void WeightSteps::rasterise(const StagedSplat& splat, const Mixture& mixture, bool golden_units, golden::Rows rows,
                            int width) {
  if (golden_units) {
    golden::ProjectedSplat p;
    const double per_unit = splat.radius / kernel_.radius();
    p.x = splat.x;
    p.y = splat.y;
    p.shape = {per_unit * per_unit, 0.0, per_unit * per_unit};
    p.reach_x = p.reach_y = kernel_.radius() * std::sqrt(p.shape.xx);
    golden_.rasterise(kernel_, p, rows, width);
    spans_ = golden_.spans();
    if (!spans_.empty()) weights_ = golden_.weights(spans_.front()) - spans_.front().weights;
    return;
  }
  const auto clip = [](double at, int low, int high) {
    return static_cast<int>(std::clamp(at, static_cast<double>(low), static_cast<double>(high)));
  };
  const int left = clip(std::ceil(splat.x - splat.radius), 0, width),
            right = clip(std::floor(splat.x + splat.radius) + 1.0, 0, width),
            top = clip(std::ceil(splat.y - splat.radius), rows.first, rows.end),
            bottom = clip(std::floor(splat.y + splat.radius) + 1.0, rows.first, rows.end);
  const bool words = mixture.device(Step::Distance);
  distances(splat.x, splat.radius, left, right - left, words, across_);
  distances(splat.y, splat.radius, top, bottom - top, words, down_);
  spans_.clear();
  own_.clear();
  for (int y = top; y < bottom; ++y) {
    const double row = down_[static_cast<std::size_t>(y - top)];
    const auto inside = [&](int x) { return row + across_[static_cast<std::size_t>(x - left)] < entries_; };
    int begin = left, end = right;
    while (begin < end && !inside(begin)) ++begin;
    while (begin < end && !inside(end - 1)) --end;
    if (begin == end) continue;
    spans_.push_back({y, begin, end - begin, own_.size()});
    for (int x = begin; x < end; ++x)
      own_.push_back(weight(row + across_[static_cast<std::size_t>(x - left)], mixture));
  }
  weights_ = own_.data();
}

}  // namespace fastsplat::stages
