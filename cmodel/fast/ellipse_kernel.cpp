// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/ellipse_kernel.hpp"

#include <algorithm>
#include <cstddef>

#include "cmodel/fast/row_kernel.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cmodel/fast/ellipse_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::cmodel::fast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::uint32_t weigh(const EllipseTable&, const EllipseCoefficients&, const EllipseBox&, std::uint16_t*) { return 0; }

#else

/// Goes down strips of a vector's width, with two additions and one table read for each row.
std::uint32_t weigh(const EllipseTable& table, const EllipseCoefficients& f, const EllipseBox& box,
                    std::uint16_t* out) {
  const hn::CappedTag<std::uint64_t, 8> d;
  const hn::Rebind<std::uint32_t, decltype(d)> half;
  const hn::RebindToSigned<decltype(half)> index;
  const hn::Rebind<std::uint16_t, decltype(d)> words;
  const std::size_t lanes = hn::Lanes(d), pitch = pitch_of(static_cast<std::uint32_t>(box.columns));
  const auto shifted = [&](std::int64_t word) { return static_cast<std::uint64_t>(word) << table.above; };
  const std::uint64_t u0 = shifted(f.u0), u1 = shifted(f.u1), u2 = shifted(f.u2), v1 = shifted(f.v1),
                      v2 = shifted(f.v2), e = shifted(f.e);
  const auto j = static_cast<std::uint64_t>(box.row);
  const std::uint64_t first = u0 + j * v1 + j * j * v2, down = v1 + (2 * j + 1) * v2;
  const auto more = hn::Set(d, 2 * v2);
  const auto end = hn::Set(index, static_cast<std::int32_t>(table.weights.size()) - 1);
  const auto none = hn::Zero(index);
  const auto* const weights = reinterpret_cast<const std::int32_t*>(table.weights.data());
  auto weighted = none;
  HWY_ALIGN std::uint64_t start[8], slope[8];
  for (std::size_t strip = 0; strip < pitch; strip += lanes) {
    const auto left = static_cast<std::int64_t>(box.columns) - static_cast<std::int64_t>(strip);
    for (std::size_t k = 0; k < lanes; ++k) {
      const auto i = static_cast<std::uint64_t>(box.column) + strip + k;
      start[k] = first + i * u1 + i * i * u2 + i * j * e;
      slope[k] = down + i * e;
    }
    const auto inside =
        hn::Lt(hn::Iota(index, 0), hn::Set(index, static_cast<std::int32_t>(std::clamp<std::int64_t>(left, 0, 8))));
    auto q = hn::Load(d, start), step = hn::Load(d, slope);
    std::uint16_t* at = out + strip;
    for (std::int32_t row = 0; row < box.rows; ++row, at += pitch) {
      const auto upper = hn::BitCast(index, hn::TruncateTo(half, hn::ShiftRight<32>(q)));
      const auto t = hn::Min(hn::ShiftRightSame(hn::Max(upper, none), table.index_shift), end);
      const auto weight = hn::IfThenElseZero(inside, hn::GatherIndex(index, weights, t));
      weighted = hn::Sub(weighted, hn::VecFromMask(index, hn::Gt(weight, none)));
      hn::StoreU(hn::TruncateTo(words, hn::BitCast(half, weight)), words, at);
      q = hn::Add(q, step);
      step = hn::Add(step, more);
    }
  }
  return static_cast<std::uint32_t>(hn::GetLane(hn::SumOfLanes(index, weighted)));
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::cmodel::fast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::cmodel::fast {
HWY_EXPORT(weigh);

std::optional<EllipseTable> ellipse_table(const Config& config, std::span<const std::uint32_t> radial,
                                          int weight_shift) {
  const Format q = config.ellipse_format();
  EllipseTable out{.weights = {}, .above = 64 - q.word_bits};
  out.index_shift = out.above + config.rlut_guard_bits + config.ellipse_frac_bits - 32;
  if (!config.has_ellipses() || out.index_shift < 0) return std::nullopt;
  for (const std::uint32_t weight : radial) {
    out.weights.push_back(weight << weight_shift);
    out.heaviest = std::max(out.heaviest, weight);
  }
  out.weights.push_back(0);
  return out;
}

std::uint32_t weigh(const EllipseTable& table, const EllipseCoefficients& f, const EllipseBox& box,
                    std::uint16_t* out) {
  return HWY_DYNAMIC_DISPATCH(weigh)(table, f, box, out);
}
}  // namespace fastsplat::cmodel::fast
#endif
