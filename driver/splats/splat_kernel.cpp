// SPDX-License-Identifier: Apache-2.0
#include "driver/splats/splat_kernel.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "driver/splats/splat_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::driver {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kMoreCentres>;
using V = hn::Vec<Doubles>;
constexpr Doubles d;

V dot(const V& x, const V& y, const V& z, const std::array<double, 3>& axis) {
  return hn::Add(hn::Add(hn::Mul(x, hn::Set(d, axis[0])), hn::Mul(y, hn::Set(d, axis[1]))),
                 hn::Mul(z, hn::Set(d, axis[2])));
}

void store_words(const V& value, double scale, double bias, std::int32_t* out) {
  const V word = hn::Floor(hn::Add(hn::Mul(value, hn::Set(d, scale)), hn::Set(d, bias)));
  const hn::Rebind<std::int32_t, Doubles> words;
  hn::StoreU(hn::DemoteTo(words, word), words, out);
}

void centres(const CentreRule& rule, const float* const (&position)[3], std::size_t count, std::int32_t* x,
             std::int32_t* y, std::int32_t* depth, double* scale) {
  const hn::Rebind<float, Doubles> floats;
  const bool perspective = std::isfinite(rule.eye);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V px = hn::PromoteTo(d, hn::LoadU(floats, position[0] + i)),
            py = hn::PromoteTo(d, hn::LoadU(floats, position[1] + i)),
            pz = hn::PromoteTo(d, hn::LoadU(floats, position[2] + i));
    const V deep = dot(px, py, pz, rule.forward);
    V size = hn::Set(d, rule.scale);
    if (perspective) size = hn::Mul(size, hn::Div(hn::Set(d, rule.eye), hn::Add(hn::Set(d, rule.eye), deep)));
    hn::StoreU(size, d, scale + i);
    store_words(hn::Add(hn::Set(d, rule.middle_x), hn::Mul(size, dot(px, py, pz, rule.right))), rule.position_scale,
                rule.position_bias, x + i);
    store_words(hn::Add(hn::Set(d, rule.middle_y), hn::Mul(size, dot(px, py, pz, rule.down))), rule.position_scale,
                rule.position_bias, y + i);
    store_words(hn::Sub(hn::Div(deep, hn::Set(d, rule.unit)), hn::Set(d, rule.first)), rule.depth_scale,
                rule.depth_bias, depth + i);
  }
}

void colours(double scale, double largest, ColourToRound* colours, std::size_t count) {
  const hn::CappedTag<double, 4> four;  // or fewer lanes
  const hn::Rebind<float, decltype(four)> floats;
  const hn::Rebind<std::int32_t, decltype(four)> integers;
  const auto half = hn::Set(four, 0.5), by = hn::Set(four, scale), most = hn::Set(four, largest), zero = hn::Zero(four);
  for (ColourToRound* one = colours; one != colours + count; ++one) {
    const auto amplitude = hn::Set(four, one->amplitude);
    double values[4];
    std::int32_t words[4];
    one->saturated = false;
    for (std::size_t c = 0; c < 4; c += hn::Lanes(four)) {
      const auto value = hn::Mul(hn::PromoteTo(four, hn::LoadU(floats, one->material.data() + c)), amplitude);
      hn::StoreU(value, four, values + c);
      const auto word = hn::Floor(hn::Add(hn::Mul(value, by), half)), kept = hn::Min(hn::Max(word, zero), most);
      one->saturated = one->saturated || !hn::AllTrue(four, hn::Eq(word, kept));
      hn::StoreU(hn::DemoteTo(integers, kept), integers, words + c);
    }
    one->asked = values[0] + values[1] + values[2] + values[3];
    for (std::size_t c = 0; c < 4; ++c) one->words[c] = static_cast<std::uint32_t>(words[c]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::driver
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::driver {
HWY_EXPORT(centres);
HWY_EXPORT(colours);

void place_centres(const CentreRule& rule, const float* const (&position)[3], std::size_t count, std::int32_t* x,
                   std::int32_t* y, std::int32_t* depth, double* scale) {
  HWY_DYNAMIC_DISPATCH(centres)(rule, position, count, x, y, depth, scale);
}
void round_colours(double scale, double largest, ColourToRound* all, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(colours)(scale, largest, all, count);
}
}  // namespace fastsplat::driver
#endif
