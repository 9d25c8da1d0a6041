// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/sample_kernel.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cmodel/fast/sample_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::cmodel::fast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void samples(const SampleTables&, bool, std::span<const SplatJob>, std::uint32_t*, std::size_t, SampleCounts&) {}

#else

#include "cmodel/fast/spread.inc"

using D = hn::ScalableTag<std::uint32_t>;
using V = hn::Vec<D>;
using Wide = hn::Repartition<std::uint64_t, D>;

V narrowed(V value, const Rounded& how) {
  return hn::Shr(hn::Add(value, hn::Set(D{}, how.bias)), hn::Set(D{}, static_cast<std::uint32_t>(how.dropped)));
}

/// Narrows a 64-bit product; the result is known to fit 32 bits.
V narrowed_product(V a, V b, const Rounded& how) {
  const Wide wide;
  const auto bias = hn::Set(wide, how.bias);
  const auto part = [&](V x, V y) { return hn::ShiftRightSame(hn::Add(hn::MulEven(x, y), bias), how.dropped); };
  const auto up = [&](V x) { return hn::BitCast(D{}, hn::ShiftRight<32>(hn::BitCast(wide, x))); };
  return hn::BitCast(D{}, hn::Or(part(a, b), hn::ShiftLeft<32>(part(up(a), up(b)))));
}

/// (1-exp(-tau))/tau, interpolated (N-6-2).
V factor(const SampleTables& tables, V tau) {
  const hn::RebindToSigned<D> index;
  const auto* const words = reinterpret_cast<const std::int32_t*>(tables.factor.data());
  const int bits = tables.plan.segment_bits;
  const auto segment = hn::BitCast(index, hn::ShiftRightSame(tau, bits));
  const V rest = hn::And(tau, hn::Set(D{}, (1U << bits) - 1));
  const V near = hn::BitCast(D{}, hn::GatherIndex(index, words, segment));
  const V far = hn::BitCast(D{}, hn::GatherIndex(index, words + 1, segment));
  return hn::Sub(near, narrowed(hn::Mul(hn::Sub(near, far), rest), tables.plan.fall));
}

/// How products become slabs. Same: additive, and neither format has more fraction bits.
enum class Rule { Same, Added, Exponential };

class Compositor {
 public:
  explicit Compositor(const SampleTables& tables)
      : tables_(tables),
        one_(hn::Set(D{}, tables.plan.one)),
        most_(hn::Set(D{}, tables.plan.most)),
        most_slab_(hn::IfThenElse(hn::Eq(take(), hn::Zero(D{})), hn::Set(D{}, tables.plan.most_slab), one_)),
        freeze_(hn::Set(D{}, tables.plan.freeze_below)) {}

  /// Words of a job's slabs. Small: all below 1.0. One: at most 1.0. Wide: colours may exceed 1.0.
  enum class Words { Small, One, Wide };
  template <Rule kRule, Words kWords>
  void draw(const SplatJob& job, std::uint32_t* picture, std::size_t row) {
    const D d;
    constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(std::uint32_t), kEach = Spread<D>::kVectors;
    HWY_ALIGN const std::uint32_t words[4] = {job.colour[0], job.colour[1], job.colour[2], job.colour[3]};
    const V colour = hn::LoadDup128(d, words);
    const std::size_t vectors = (job.columns * std::size_t{4} + kLanes - 1) / kLanes, pitch = pitch_of(job.columns);
    for (std::size_t j = 0; j < job.rows; ++j) {
      std::uint32_t* out = picture + (job.at + j * row) * 4;
      const std::uint16_t* weights = job.weights + j * pitch;
      for (std::size_t v = 0; v < vectors; ++v) {
        const auto eight =
            hn::BitCast(d, hn::LoadDup128(hn::Repartition<std::uint16_t, D>{}, weights + 8 * (v / kEach)));
        const V weight = spread_(eight, v % kEach);
        const auto weighted = hn::Ne(weight, hn::Zero(d));
        if (hn::AllFalse(d, weighted)) continue;
        const V slab = this->slab<kRule>(narrowed(hn::Mul(colour, weight), tables_.plan.product));
        const V before = hn::LoadU(d, out + v * kLanes), seen = hn::Broadcast<3>(before);
        const auto closed = hn::Lt(seen, freeze_);
        frozen_ = hn::Sub(frozen_, hn::VecFromMask(d, hn::And(closed, weighted)));
        V light;
        if constexpr (kWords == Words::Wide) {
          opaque_ = hn::Sub(opaque_, hn::VecFromMask(d, hn::Gt(slab, most_slab_)));
          light = narrowed_product(seen, hn::Min(slab, most_slab_), tables_.plan.light);
        } else {
          light = narrowed(hn::Mul(seen, slab), tables_.plan.light);
        }
        if constexpr (kWords == Words::One) {
          opaque_ = hn::Sub(opaque_, hn::VecFromMask(d, hn::Gt(slab, one_)));
          // 1.0 times transmittance is transmittance; the product may not fit a lane.
          light = hn::IfThenElse(hn::Eq(hn::Min(slab, one_), one_), seen, light);
        }
        const V shown = hn::IfThenZeroElse(closed, light);
        const V after = hn::Add(before, hn::Sub(hn::Xor(shown, take()), take()));
        bright_ = hn::Sub(bright_, hn::VecFromMask(d, hn::Gt(after, most_)));
        hn::StoreU(hn::Min(after, most_), d, out + v * kLanes);
      }
    }
  }
  template <Rule kRule>
  void draw(std::span<const SplatJob> jobs, std::uint32_t* picture, std::size_t row) {
    for (const SplatJob& job : jobs) {
      if (is_small(tables_, std::max({job.colour[0], job.colour[1], job.colour[2], job.colour[3]})))
        draw<kRule, Words::Small>(job, picture, row);
      else if (tables_.plan.wide)
        draw<kRule, Words::Wide>(job, picture, row);
      else
        draw<kRule, Words::One>(job, picture, row);
    }
  }
  void count(SampleCounts& counts) const {
    const auto sum = [](V lanes) { return std::uint64_t{hn::GetLane(hn::SumOfLanes(D{}, lanes))}; };
    counts.frozen += sum(hn::And(frozen_, take()));
    counts.opacity_saturated += sum(opaque_);
    counts.composite_saturated += sum(bright_);
  }

 private:
  /// ~0 in T's lanes, from which light is taken; 0 in the others, to which it is added.
  static V take() {
    HWY_ALIGN static constexpr std::uint32_t kTake[4] = {0, 0, 0, ~0U};
    return hn::LoadDup128(D{}, kTake);
  }
  template <Rule kRule>
  V slab(V product) const {
    const SamplePlan& plan = tables_.plan;
    if constexpr (kRule == Rule::Same) return product;
    if constexpr (kRule == Rule::Added) return narrowed(hn::ShiftLeftSame(product, plan.grown), plan.added);
    return narrowed_product(product, factor(tables_, hn::Broadcast<3>(product)), plan.slab);
  }

  const SampleTables& tables_;
  const Spread<D> spread_;
  const V one_, most_, most_slab_, freeze_;
  V frozen_ = hn::Zero(D{}), opaque_ = hn::Zero(D{}), bright_ = hn::Zero(D{});
};

void samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs, std::uint32_t* picture,
             std::size_t row, SampleCounts& counts) {
  Compositor compositor(tables);
  if (exponential)
    compositor.draw<Rule::Exponential>(jobs, picture, row);
  else if (tables.plan.grown == 0 && tables.plan.added.dropped == 0)
    compositor.draw<Rule::Same>(jobs, picture, row);
  else
    compositor.draw<Rule::Added>(jobs, picture, row);
  compositor.count(counts);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::cmodel::fast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::cmodel::fast {
HWY_EXPORT(samples);

void composite_samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs,
                       std::uint32_t* picture, std::size_t row, SampleCounts& counts) {
  HWY_DYNAMIC_DISPATCH(samples)(tables, exponential, jobs, picture, row, counts);
}
}  // namespace fastsplat::cmodel::fast
#endif
