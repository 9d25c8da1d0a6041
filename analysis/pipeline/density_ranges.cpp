// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/density_ranges.hpp"

#include <algorithm>
#include <cmath>

#include "cmodel/classify/classify_tables.hpp"

namespace fastsplat::stages {
namespace {

namespace words = cmodel::classify;

/// Of sums and roots of doubles, relative.
constexpr double kDoubles = 1e-13;
/// Of the transfer function's floats, which need not be monotonic to the last bit; relative.
constexpr double kFloats = 0x1p-21;

/// A root from its table times the root of its argument m, 1..4, is off 1 by at most this. The chord of a segment of
/// 1/32 is 3/4 h^2/8 high. An entry and the fall are half a word off each, of roots of at least 1/2. m is rounded down.
constexpr double kRoot = 0.75 / 8.0 * 0x1p-10 + 4.0 * 0x1p-15 + 0x1p-16;
static_assert(words::kRootBits == 5 && words::kRoot == 14 && words::kSlope == 16);

Range operator-(const Range& a, const Range& b) { return {a.low - b.high, a.high - b.low}; }
Range operator*(double factor, const Range& a) {
  return factor < 0.0 ? Range{factor * a.high, factor * a.low} : Range{factor * a.low, factor * a.high};
}
/// Of a function that keeps order.
template <class Function>
Range each(const Range& a, Function function) {
  return {function(a.low), function(a.high)};
}
Range widened(const Range& a, double relative) {
  return {a.low - relative * std::abs(a.low), a.high + relative * std::abs(a.high)};
}
void include(Range& range, double value) {
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

}  // namespace

DensityRanges::DensityRanges(const DensitySteps& steps, const Mixture& mixture) : steps_(steps), mixture_(mixture) {
  const scene::Scene& scene = steps.scene_;
  for (const scene::ControlPoint& point : scene::resolved(scene.transfer_function, *scene.volume).points)
    bends_.push_back((point.at - steps.base_) / steps.range_);
}

void DensityRanges::transfer(const Range& density, ClassifiedRange& out) const {
  const DensitySteps::Visible low = steps_.transfer(density.low, mixture_);
  out.tau = {low.tau, low.tau};
  for (std::size_t c = 0; c < 3; ++c) out.colour[c] = {low.colour[c], low.colour[c]};
  const auto take = [&](double at) {
    const DensitySteps::Visible seen = steps_.transfer(at, mixture_);
    include(out.tau, seen.tau);
    for (std::size_t c = 0; c < 3; ++c) include(out.colour[c], seen.colour[c]);
  };
  take(density.high);
  if (mixture_.device(Step::Transfer)) {
    const auto segments = static_cast<double>(steps_.classify_lines_.segments());
    const double last = std::min(density.high * segments, segments);
    for (double entry = std::floor(density.low * segments) + 1.0; entry < last; entry += 1.0) take(entry / segments);
    return;
  }
  for (const double bend : bends_) {
    if (density.low < bend && bend < density.high) take(bend);
  }
  out.tau = widened(out.tau, kFloats);
  for (Range& colour : out.colour) colour = widened(colour, kFloats);
}

DensityRanges::Ranges DensityRanges::slope(const DensityRange& pixel) const {
  const bool device = mixture_.device(Step::Slope);
  const auto& scales = (device ? steps_.words_ : steps_.real_)[static_cast<std::size_t>(pixel.sheet)];
  const Range right = scales.across * pixel.across[0], down = scales.across * pixel.across[1],
              along = scales.along * pixel.across[2];
  if (!device) {
    const glm::dvec2 tilt = steps_.geometry_.tilt(pixel.x, pixel.y);
    return {right, down, along - tilt.x * right - tilt.y * down};
  }
  const auto& t = steps_.tilts_;
  const double tx = steps_.tilt_(t[0] + pixel.x * t[1]), ty = steps_.tilt_(t[2] + pixel.y * t[3]);
  const Range gx = each(right, steps_.across_), gy = each(down, steps_.across_);
  return {gx, gy, each(along - tx * gx - ty * gy, steps_.along_)};
}

Range DensityRanges::length(const Ranges& slope) const {
  double least = 0.0, most = 0.0;
  for (const Range& part : slope) {
    const double near = std::max({part.low, -part.high, 0.0}), far = std::max(part.high, -part.low);
    least += near * near;
    most += far * far;
  }
  const double by = kDoubles + (mixture_.device(Step::Normal) ? kRoot : 0.0);
  const Range out = widened({std::sqrt(least), std::sqrt(most)}, by);
  return mixture_.device(Step::Normal) ? each(out, steps_.length_) : out;
}

Range DensityRanges::facing(const Ranges& slope, const DensitySteps::Vector& real,
                            const DensitySteps::Vector& from_words) const {
  const bool device = mixture_.device(Step::Facing);
  const DensitySteps::Vector& to = device ? from_words : real;
  // The normals of all gradients within `far` of the middle one lie in a cone about its normal.
  double square = 0.0, far = 0.0, along = 0.0, of_vector = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double middle = 0.5 * (slope[axis].low + slope[axis].high), half = 0.5 * (slope[axis].high - slope[axis].low);
    square += middle * middle;
    far += half * half;
    along += middle * to[axis];
    of_vector += to[axis] * to[axis];
  }
  const double vector = std::sqrt(of_vector);
  Range cosine{0.0, 1.0};
  if (far < square) {
    constexpr double kSine = 1e-7;  // of the root of 1 less a double next to 1
    const double c = std::min(1.0, std::abs(along) / (std::sqrt(square) * vector)), s = std::sqrt(1.0 - c * c),
                 sine = std::sqrt(far / square), less = std::sqrt(1.0 - far / square);
    cosine.low = std::max(0.0, c * less - (s + kSine) * sine);
    if (c < less) cosine.high = std::min(1.0, c * less + (s + kSine) * sine);
  }
  const Range out = vector * widened(cosine, 10.0 * kDoubles + (mixture_.device(Step::Normal) ? kRoot : 0.0));
  return device ? each(out, steps_.facing_) : out;
}

Range DensityRanges::blend(const Ranges& slope, int sheet) const {
  // Without a gradient there is no shading, and a length may round to 0.
  const Range at = length(slope);
  const bool flat = std::ranges::all_of(slope, [](const Range& part) { return part.low == 0.0 && part.high == 0.0; });
  return {at.low > 0.0 ? steps_.blend(at.low, sheet, mixture_) : 0.0,
          flat ? 0.0 : steps_.blend(at.high, sheet, mixture_)};
}

ClassifiedRange DensityRanges::operator()(const DensityRange& pixel) const {
  ClassifiedRange out;
  transfer(pixel.density, out);
  if (!(out.tau.high > 0.0)) return out;
  Range share, matt, shine;
  if (steps_.scene_.shading.on) {
    const Ranges g = slope(pixel);
    share = blend(g, pixel.sheet);
    if (share.high > 0.0) {
      const Range to_light = facing(g, steps_.light_, steps_.light_words_),
                  to_half = facing(g, steps_.half_, steps_.half_words_);
      const bool device = mixture_.device(Step::Phong);
      const auto& phong = device ? steps_.phong_words_ : steps_.phong_;
      matt = each(to_light, [&](double facing) {
        const double exact = phong.ambient + phong.diffuse * facing;
        return device ? steps_.matt_(exact) : exact;
      });
      shine = each(to_half, [&](double facing) { return steps_.glint(std::max(facing, 0.0), mixture_); });
    }
  }
  // (1 - h) E + h (E matt + glint) grows with E, matt and glint, and is linear in h.
  const auto lit = [&](double plain, double share_of, double matt_of, double glint) {
    const double mixed = plain + share_of * (plain * matt_of + glint - plain);
    return mixture_.device(Step::Shaded) ? steps_.lit_(mixed) : std::clamp(mixed, 0.0, 1.0);
  };
  for (Range& colour : out.colour) {
    const double least = std::max(colour.low, 0.0), most = colour.high;
    colour = {std::min(lit(least, share.low, matt.low, shine.low), lit(least, share.high, matt.low, shine.low)),
              std::max(lit(most, share.low, matt.high, shine.high), lit(most, share.high, matt.high, shine.high))};
    if (!mixture_.device(Step::Shaded)) colour = widened(colour, 1e-12);
  }
  if (mixture_.device(Step::Colour)) {
    out.rounded = 0.5 / steps_.product_.scale();
    out.largest = steps_.product_.greatest();
  }
  return out;
}

}  // namespace fastsplat::stages
