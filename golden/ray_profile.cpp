// SPDX-License-Identifier: Apache-2.0
#include "golden/ray_profile.hpp"

#include <algorithm>
#include <cmath>

#include "golden/walk_kernel.hpp"

namespace fastsplat::golden {

RaySamples::RaySamples(double half_depth)
    : first(-std::ceil(half_depth * kSamplesPerUnit)), count(static_cast<std::size_t>(-2.0 * first)) {}

RayProfile::RayProfile(const scene::Kernel& kernel, const RaySamples& samples)
    : a_(kernel.a()),
      radius_(kernel.radius()),
      shrink_(std::exp(-2.0 * kernel.a() * kSampleStep * kSampleStep)),
      samples_(samples.count),
      begin_(samples.count),
      end_(0) {}

void RayProfile::add(const RayHit& hit) {
  // `nearest` is the last sample not behind the centre, `offset` its depth relative to the centre, in (-step, 0].
  const double nearest = std::floor(hit.position);
  const double offset = (nearest - hit.position) * kSampleStep;
  const auto nearer = static_cast<std::ptrdiff_t>(nearest);
  walk(hit.amount, nearer, -1, -offset);
  walk(hit.amount, nearer + 1, +1, kSampleStep + offset);
}

void RayProfile::walk(const Sums& amount, std::ptrdiff_t sample, std::ptrdiff_t direction, double distance) {
  double value = std::exp(-a_ * distance * distance);
  double ratio = std::exp(-a_ * kSampleStep * (2.0 * distance + kSampleStep));
  for (; distance < radius_; distance += kSampleStep, sample += direction) {
    if (sample < 0 || sample >= static_cast<std::ptrdiff_t>(samples_.size())) return;
    Sums& sums = samples_[static_cast<std::size_t>(sample)];
    for (int c = 0; c < 4; ++c) sums[c] += amount[c] * value;
    begin_ = std::min(begin_, static_cast<std::size_t>(sample));
    end_ = std::max(end_, static_cast<std::size_t>(sample) + 1);
    value *= ratio;
    ratio *= shrink_;
  }
}

void RayProfile::begin_part(std::size_t begin, std::size_t end) { part_begin_ = begin, part_end_ = end; }

void RayProfile::add_to_part(const RayHit& hit) {
  waiting_.push_back(hit);
  if (waiting_.size() == kWalkedTogether) flush();
}

void RayProfile::flush() {
  if (waiting_.empty()) return;
  // Samples that no hit reaches stay 0, so marking the whole part as touched would do. These are the samples reached.
  double first = waiting_.front().position, last = first;
  for (const RayHit& hit : waiting_) first = std::min(first, hit.position), last = std::max(last, hit.position);
  const double reach = radius_ * kSamplesPerUnit + 2.0;
  const auto inside = [&](double at) {
    return static_cast<std::size_t>(std::clamp(at, static_cast<double>(part_begin_), static_cast<double>(part_end_)));
  };
  begin_ = std::min(begin_, inside(first - reach));
  end_ = std::max(end_, inside(last + reach));
  walk_hits({a_, radius_, shrink_}, waiting_, samples_.data(), part_begin_, part_end_);
  waiting_.clear();
}

void RayProfile::clear() {
  if (begin_ < end_) std::fill(samples_.begin() + begin_, samples_.begin() + end_, Sums{});
  begin_ = samples_.size();
  end_ = 0;
}

}  // namespace fastsplat::golden
