// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/sample_kernel.hpp"

#include <algorithm>
#include <bit>

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
bool whole(std::size_t) { return false; }
CompositedBlocks sums16(const SampleTables&, bool, const SumBlocks<std::uint16_t>&, SampleCounts&) { return {}; }
CompositedBlocks sums32(const SampleTables&, bool, const SumBlocks<std::uint32_t>&, SampleCounts&) { return {}; }

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
bool is_same(const SamplePlan& plan) { return plan.grown == 0 && plan.added.dropped == 0; }

/// Words of slabs. Small: all below 1.0. One: colours end at 1.0. Wide: colours may exceed 1.0.
enum class Words { Small, One, Wide };

/// Puts slabs behind the picture.
class Compositor {
 public:
  explicit Compositor(const SampleTables& tables)
      : tables_(tables),
        one_(hn::Set(D{}, tables.plan.one)),
        most_(hn::Set(D{}, tables.plan.most)),
        most_slab_(hn::IfThenElse(hn::Eq(take(), hn::Zero(D{})), hn::Set(D{}, tables.plan.most_slab), one_)),
        freeze_(hn::Set(D{}, tables.plan.freeze_below)) {}

  /// The slab's words of a product or sum.
  template <Rule kRule>
  V slab(V product) const {
    const SamplePlan& plan = tables_.plan;
    if constexpr (kRule == Rule::Same) return product;
    if constexpr (kRule == Rule::Added) return narrowed(hn::ShiftLeftSame(product, plan.grown), plan.added);
    return narrowed_product(product, factor(tables_, hn::Broadcast<3>(product)), plan.slab);
  }
  /// The picture's words with the slab behind them. `visited`: pixels that are counted.
  template <Words kWords, class M>
  V over(V before, V slab, M visited) {
    const D d;
    const V seen = hn::Broadcast<3>(before);
    const auto closed = hn::Lt(seen, freeze_);
    frozen_ = hn::Sub(frozen_, hn::VecFromMask(d, hn::And(closed, visited)));
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
    return hn::Min(after, most_);
  }
  void count(SampleCounts& counts) const {
    const auto sum = [](V lanes) { return std::uint64_t{hn::GetLane(hn::SumOfLanes(D{}, lanes))}; };
    counts.frozen += sum(hn::And(frozen_, take()));
    counts.opacity_saturated += sum(opaque_);
    counts.composite_saturated += sum(bright_);
  }

 protected:
  /// ~0 in T's lanes, from which light is taken; 0 in the others, to which it is added.
  static V take() {
    HWY_ALIGN static constexpr std::uint32_t kTake[4] = {0, 0, 0, ~0U};
    return hn::LoadDup128(D{}, kTake);
  }

  const SampleTables& tables_;
  const V one_, most_, most_slab_, freeze_;
  V frozen_ = hn::Zero(D{}), opaque_ = hn::Zero(D{}), bright_ = hn::Zero(D{});
};

class Samples final : public Compositor {
 public:
  using Compositor::Compositor;

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

 private:
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
        const V one = this->slab<kRule>(narrowed(hn::Mul(colour, weight), tables_.plan.product));
        hn::StoreU(over<kWords>(hn::LoadU(d, out + v * kLanes), one, weighted), d, out + v * kLanes);
      }
    }
  }

  const Spread<D> spread_;
};

class Sums final : public Compositor {
 public:
  using Compositor::Compositor;

  template <Rule kRule, class T>
  CompositedBlocks draw(const SumBlocks<T>& of) {
    return tables_.plan.wide ? draw<kRule, Words::Wide>(of) : draw<kRule, Words::One>(of);
  }

 private:
  static V load(const std::uint32_t* sums) { return hn::LoadU(D{}, sums); }
  static V load(const std::uint16_t* sums) {
    return hn::PromoteTo(D{}, hn::LoadU(hn::Rebind<std::uint16_t, D>{}, sums));
  }

  template <Rule kRule, Words kWords, class T>
  CompositedBlocks draw(const SumBlocks<T>& of) {
    const D d;
    constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(std::uint32_t);
    const auto every = hn::Eq(one_, one_);
    const V largest = hn::Set(d, of.largest);
    CompositedBlocks out;
    V greatest = hn::Zero(d);
    for (std::uint64_t left = of.blocks; left != 0; left &= left - 1) {
      const std::size_t block = static_cast<std::size_t>(std::countr_zero(left)) * of.side;
      V most = hn::Zero(d);  // words of its picture
      for (std::size_t j = 0; j < of.rows; ++j) {
        const T* sums = of.sums + (j * of.sums_row + block) * 4;
        std::uint32_t* picture = of.picture + (j * of.picture_row + block) * 4;
        for (std::size_t v = 0; v < of.side * 4; v += kLanes) {
          const V sum = load(sums + v);
          greatest = hn::Max(greatest, sum);
          // The factor table has no entry for a larger one.
          const V after = over<kWords>(hn::LoadU(d, picture + v), this->slab<kRule>(hn::Min(sum, largest)), every);
          most = hn::Max(most, after);
          hn::StoreU(after, d, picture + v);
        }
      }
      if (hn::AllTrue(d, hn::Lt(hn::Broadcast<3>(most), freeze_))) out.terminated |= left & (~left + 1);
    }
    out.sound = hn::AllFalse(d, hn::Gt(greatest, largest));
    return out;
  }
};

void samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs, std::uint32_t* picture,
             std::size_t row, SampleCounts& counts) {
  Samples all(tables);
  if (exponential)
    all.draw<Rule::Exponential>(jobs, picture, row);
  else if (is_same(tables.plan))
    all.draw<Rule::Same>(jobs, picture, row);
  else
    all.draw<Rule::Added>(jobs, picture, row);
  all.count(counts);
}

bool whole(std::size_t side) { return side * 4 % (HWY_MAX_BYTES / sizeof(std::uint32_t)) == 0; }

template <class T>
CompositedBlocks sums(const SampleTables& tables, bool exponential, const SumBlocks<T>& of, SampleCounts& counts) {
  Sums all(tables);
  const CompositedBlocks out = exponential            ? all.draw<Rule::Exponential>(of)
                               : is_same(tables.plan) ? all.draw<Rule::Same>(of)
                                                      : all.draw<Rule::Added>(of);
  all.count(counts);
  return out;
}
CompositedBlocks sums16(const SampleTables& tables, bool exponential, const SumBlocks<std::uint16_t>& of,
                        SampleCounts& counts) {
  return sums(tables, exponential, of, counts);
}
CompositedBlocks sums32(const SampleTables& tables, bool exponential, const SumBlocks<std::uint32_t>& of,
                        SampleCounts& counts) {
  return sums(tables, exponential, of, counts);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::cmodel::fast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::cmodel::fast {
HWY_EXPORT(samples);
HWY_EXPORT(whole);
HWY_EXPORT(sums16);
HWY_EXPORT(sums32);

bool composites_sums(std::size_t side) { return HWY_DYNAMIC_DISPATCH(whole)(side); }

CompositedBlocks composite_sums(const SampleTables& tables, bool exponential, const SumBlocks<std::uint16_t>& of,
                                SampleCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(sums16)(tables, exponential, of, counts);
}
CompositedBlocks composite_sums(const SampleTables& tables, bool exponential, const SumBlocks<std::uint32_t>& of,
                                SampleCounts& counts) {
  return HWY_DYNAMIC_DISPATCH(sums32)(tables, exponential, of, counts);
}

void composite_samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs,
                       std::uint32_t* picture, std::size_t row, SampleCounts& counts) {
  HWY_DYNAMIC_DISPATCH(samples)(tables, exponential, jobs, picture, row, counts);
}
}  // namespace fastsplat::cmodel::fast
#endif
