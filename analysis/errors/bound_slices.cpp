// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/bound_slices.hpp"

#include <algorithm>
#include <cmath>

namespace fastsplat::analysis {
namespace {

/// Four roundings of floats, relative.
constexpr double kFloats = 0x1p-22;

stages::Growth growth_of(const stages::StagedShape* shape) {
  return shape != nullptr ? shape->growth : stages::Growth{};
}

}  // namespace

SliceBound::Boundary SliceBound::boundary(const stages::StagedSplat& splat, const stages::Growth& growth,
                                          int at) const {
  const stages::SplatSteps& steps = chain_.steps();
  if (at == 0 || at == steps.sheets()) return {};
  Boundary out;
  const double behind = std::abs(steps.behind(splat, at, known_));
  if (r_.depth > 0.0) {
    // A kernel that grew: its depth is multiplied by the word shrink, and rounded down again.
    const double shrink = std::ldexp(growth.shrink, -16), grown = 1.0 / growth.real;
    out.error = r_.depth * grown + (behind + r_.depth) * std::abs(shrink - grown) +
                (growth.shrink < (1U << 16) ? r_.depth : 0.0);
    out.near = std::max(0.0, behind * grown - out.error);
    out.inside = out.near < chain_.scene().kernel.radius();
    return out;
  }
  const double in_front = steps.phi(splat, at, known_, growth);
  out.inside = in_front > 0.0 && in_front < 1.0;
  return out;
}

int SliceBound::first(const stages::StagedSplat& splat, const stages::StagedShape* shape) const {
  int first = splat.first;
  if (r_.depth == 0.0 || chain_.gaussians() != nullptr || !chain_.steps().sliced()) return first;
  while (first > 0 && boundary(splat, growth_of(shape), first).inside) --first;
  return first;
}

const Sliced& SliceBound::operator()(const stages::StagedSplat& splat, const stages::StagedShape* shape, double ratio) {
  Sliced& s = sliced_;
  chain_.shares(splat, shape, known_, s.value);
  s.first = splat.first;
  s.whole = splat.value;
  for (std::size_t c = 0; c < 4; ++c) {
    // A rounded word is off by no more than the value itself.
    const double word = r_.carries ? r_.emission : std::min(r_.emission, splat.value[c] * ratio);
    // Of densities the driver quantises floats.
    const double narrow = r_.emission > 0.0 && chain_.holds_densities() ? kFloats * splat.value[c] : 0.0;
    s.whole_error[c] = word / ratio + narrow + std::max(0.0, splat.value[c] - r_.largest_whole / ratio);
  }
  const bool sliced = chain_.gaussians() == nullptr && chain_.steps().sliced();
  if (!sliced || r_.shares_known) {  // whole splats, or shares that are known
    s.part.assign(s.size(), sliced ? 0.0 : 1.0);
    s.cut.assign(s.size() + 1, 0.0);
    s.word.assign(s.size() + 1, 0.0);
  } else {
    const stages::SplatSteps& steps = chain_.steps();
    const stages::Growth growth = growth_of(shape);
    if (r_.depth > 0.0) {  // the device's splat may begin some slabs earlier, or end some later
      const int first_of_all = first(splat, shape);
      s.value.insert(s.value.begin(), static_cast<std::size_t>(s.first - first_of_all), golden::Sums{});
      s.first = first_of_all;
      const auto end = [&] { return s.first + static_cast<int>(s.size()); };
      while (end() < steps.sheets() && boundary(splat, growth, end()).inside) s.value.emplace_back();
    }
    s.part.clear();
    s.cut.clear();
    s.word.clear();
    for (std::size_t i = 0; i <= s.size(); ++i) {
      const int at = s.first + static_cast<int>(i);
      if (i > 0) s.part.push_back(steps.phi(splat, at, known_, growth) - steps.phi(splat, at - 1, known_, growth));
      const Boundary cut = boundary(splat, growth, at);
      // The kernel falls off to both sides, so its profile is greatest where the boundary comes nearest to the centre.
      s.cut.push_back(cut.inside ? cut.error * chain_.scene().kernel.profile(cut.near) + r_.phi : 0.0);
      s.word.push_back((cut.inside ? r_.share : i == s.size() ? r_.last_share : 0.0) / ratio);
    }
  }
  s.share_error.assign(s.size(), golden::Sums{});
  s.over.assign(s.size(), golden::Sums{});
  for (std::size_t m = 0; m < s.size(); ++m) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double error =
          s.whole_error[c] * s.part[m] + (s.cut[m] + s.cut[m + 1]) * splat.value[c] + s.word[m] + s.word[m + 1];
      s.over[m][c] = std::max(0.0, s.value[m][c] + error - r_.largest_share / ratio);
      s.share_error[m][c] = error + s.over[m][c];
    }
  }
  return sliced_;
}

}  // namespace fastsplat::analysis
