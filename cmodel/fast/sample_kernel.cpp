#include "cmodel/fast/sample_kernel.hpp"

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
  return hn::ShiftRightSame(hn::Add(value, hn::Set(D{}, how.bias)), how.dropped);
}

/// A product of 64 bits narrowed; it is known to fit 32 bits then.
V narrowed_product(V a, V b, const Rounded& how) {
  const Wide wide;
  const auto bias = hn::Set(wide, how.bias);
  const auto part = [&](V x, V y) { return hn::ShiftRightSame(hn::Add(hn::MulEven(x, y), bias), how.dropped); };
  const auto up = [&](V x) { return hn::BitCast(D{}, hn::ShiftRight<32>(hn::BitCast(wide, x))); };
  return hn::BitCast(D{}, hn::Or(part(a, b), hn::ShiftLeft<32>(part(up(a), up(b)))));
}

/// (1-exp(-tau))/tau.
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

template <bool kExponential>
void composite(const SampleTables& tables, std::span<const SplatJob> jobs, std::uint32_t* picture, std::size_t row,
               SampleCounts& counts) {
  const D d;
  const SamplePlan& plan = tables.plan;
  const Spread<D> spread;
  constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(std::uint32_t), kEach = Spread<D>::kVectors;
  const V zero = hn::Zero(d), one = hn::Set(d, plan.one), most = hn::Set(d, plan.most);
  const V freeze = hn::Set(d, plan.freeze_below);
  HWY_ALIGN static constexpr std::uint32_t kTake[4] = {0, 0, 0, ~0U};
  const V take = hn::LoadDup128(d, kTake);  // from transmittance, where others add
  V frozen = zero, opaque = zero, bright = zero;
  for (const SplatJob& job : jobs) {
    HWY_ALIGN const std::uint32_t words[4] = {job.colour[0], job.colour[1], job.colour[2], job.colour[3]};
    const V colour = hn::LoadDup128(d, words);
    const std::size_t vectors = (job.columns * std::size_t{4} + kLanes - 1) / kLanes, pitch = pitch_of(job.columns);
    for (std::size_t j = 0; j < job.rows; ++j) {
      std::uint32_t* out = picture + (job.at + j * row) * 4;
      const std::uint16_t* weights = job.weights + j * pitch;
      for (std::size_t v = 0; v < vectors; ++v) {
        const auto eight =
            hn::BitCast(d, hn::LoadDup128(hn::Repartition<std::uint16_t, D>{}, weights + 8 * (v / kEach)));
        const V weight = spread(eight, v % kEach);
        const auto weighted = hn::Ne(weight, zero);
        if (hn::AllFalse(d, weighted)) continue;
        const V product = narrowed(hn::Mul(colour, weight), plan.product);
        const V slab = kExponential ? narrowed_product(product, factor(tables, hn::Broadcast<3>(product)), plan.slab)
                                    : narrowed(hn::ShiftLeftSame(product, plan.grown), plan.added);
        opaque = hn::Sub(opaque, hn::VecFromMask(d, hn::Gt(slab, one)));
        const V before = hn::LoadU(d, out + v * kLanes), seen = hn::Broadcast<3>(before);
        const auto closed = hn::Lt(seen, freeze);
        frozen = hn::Sub(frozen, hn::VecFromMask(d, hn::And(closed, weighted)));
        // 1.0 times transmittance is transmittance, and does not fit a lane.
        const V light =
            hn::IfThenElse(hn::Eq(hn::Min(slab, one), one), seen, narrowed(hn::Mul(seen, slab), plan.light));
        const V shown = hn::IfThenZeroElse(closed, light);
        const V after = hn::Add(before, hn::Sub(hn::Xor(shown, take), take));
        bright = hn::Sub(bright, hn::VecFromMask(d, hn::Gt(after, most)));
        hn::StoreU(hn::Min(after, most), d, out + v * kLanes);
      }
    }
  }
  const auto sum = [&](V lanes) { return std::uint64_t{hn::GetLane(hn::SumOfLanes(d, lanes))}; };
  counts.frozen += sum(hn::And(frozen, take));
  counts.opacity_saturated += sum(opaque);
  counts.composite_saturated += sum(bright);
}

void samples(const SampleTables& tables, bool exponential, std::span<const SplatJob> jobs, std::uint32_t* picture,
             std::size_t row, SampleCounts& counts) {
  if (exponential)
    composite<true>(tables, jobs, picture, row, counts);
  else
    composite<false>(tables, jobs, picture, row, counts);
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
