// SPDX-License-Identifier: Apache-2.0
#include "golden/walk_kernel.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "golden/walk_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef FASTSPLAT_GOLDEN_WALK_ONCE
#define FASTSPLAT_GOLDEN_WALK_ONCE
namespace fastsplat::golden {

/// Start and results of the recurrence in one direction from the centres of up to four hits.
struct Walk {
  static constexpr std::size_t kMostSteps = 8 * kSamplesPerUnit + 2;  // the kernel's radius is at most 8
  alignas(64) double distance[kWalkedTogether] = {};
  alignas(64) double value[kWalkedTogether] = {};
  alignas(64) double ratio[kWalkedTogether] = {};
  alignas(64) double steps[kWalkedTogether] = {};  ///< number of samples within the kernel
  alignas(64) double values[kMostSteps][kWalkedTogether];

  void begin(const WalkShape& shape, std::size_t hit, double from) {
    distance[hit] = from;
    value[hit] = std::exp(-shape.a * from * from);
    ratio[hit] = std::exp(-shape.a * kSampleStep * (2.0 * from + kSampleStep));
  }
};

}  // namespace fastsplat::golden
#endif

HWY_BEFORE_NAMESPACE();
namespace fastsplat::golden {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
constexpr std::size_t kLanes = 1;
#elif HWY_MAX_BYTES < 32
constexpr std::size_t kLanes = 2;
#else
constexpr std::size_t kLanes = 4;
#endif
constexpr std::size_t kParts = 4 / kLanes;
using Part = hn::CappedTag<double, kLanes>;

/// Runs all hits' recurrence until all are outside the kernel.
void run(const WalkShape& shape, Walk& walk) {
  const Part d;
  const auto radius = hn::Set(d, shape.radius), step = hn::Set(d, kSampleStep), shrink = hn::Set(d, shape.shrink);
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t lane = part * kLanes;
    auto distance = hn::Load(d, walk.distance + lane), value = hn::Load(d, walk.value + lane),
         ratio = hn::Load(d, walk.ratio + lane), steps = hn::Zero(d);
    for (std::size_t i = 0;; ++i) {
      const auto inside = hn::Lt(distance, radius);
      if (hn::AllFalse(d, inside)) break;
      hn::Store(value, d, walk.values[i] + lane);
      steps = hn::Add(steps, hn::IfThenElseZero(inside, hn::Set(d, 1.0)));
      distance = hn::Add(distance, step);
      value = hn::Mul(value, ratio);
      ratio = hn::Mul(ratio, shrink);
    }
    hn::Store(steps, d, walk.steps + lane);
  }
}

/// Adds steps [first, end) of one hit to the samples at sample + direction * step.
void add(const Walk& walk, std::size_t hit, const Sums& amount, Sums* samples, std::ptrdiff_t sample,
         std::ptrdiff_t direction, std::ptrdiff_t first, std::ptrdiff_t end) {
  const Part d;
  hn::Vec<Part> parts[kParts];
  for (std::size_t part = 0; part < kParts; ++part) parts[part] = hn::LoadU(d, amount.data() + part * kLanes);
  for (std::ptrdiff_t i = first; i < end; ++i) {
    const auto value = hn::Set(d, walk.values[i][hit]);
    double* sums = samples[sample + direction * i].data();
    for (std::size_t part = 0; part < kParts; ++part) {
      double* at = sums + part * kLanes;
      hn::StoreU(hn::Add(hn::LoadU(d, at), hn::Mul(parts[part], value)), d, at);
    }
  }
}

void walk_all(const WalkShape& shape, const RayHit* hits, std::size_t count, Sums* samples, std::ptrdiff_t begin,
              std::ptrdiff_t end) {
  Walk nearer, farther;
  std::ptrdiff_t nearest[kWalkedTogether] = {};
  for (std::size_t h = 0; h < kWalkedTogether; ++h) {
    // Lanes without a hit repeat the first.
    const double position = hits[h < count ? h : 0].position;
    const double floor = std::floor(position);
    const double offset = (floor - position) * kSampleStep;
    nearest[h] = static_cast<std::ptrdiff_t>(floor);
    nearer.begin(shape, h, -offset);
    farther.begin(shape, h, kSampleStep + offset);
  }
  run(shape, nearer);
  run(shape, farther);
  for (std::size_t h = 0; h < count; ++h) {
    const auto near_steps = static_cast<std::ptrdiff_t>(nearer.steps[h]);
    const auto far_steps = static_cast<std::ptrdiff_t>(farther.steps[h]);
    const std::ptrdiff_t before = nearest[h], behind = nearest[h] + 1;
    add(nearer, h, hits[h].amount, samples, before, -1, std::max<std::ptrdiff_t>(0, before - (end - 1)),
        std::min(near_steps, before - begin + 1));
    add(farther, h, hits[h].amount, samples, behind, +1, std::max<std::ptrdiff_t>(0, begin - behind),
        std::min(far_steps, end - behind));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::golden
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::golden {
HWY_EXPORT(walk_all);

void walk_hits(const WalkShape& shape, std::span<const RayHit> hits, Sums* samples, std::size_t begin,
               std::size_t end) {
  HWY_DYNAMIC_DISPATCH(walk_all)
  (shape, hits.data(), hits.size(), samples, static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
}
}  // namespace fastsplat::golden
#endif
