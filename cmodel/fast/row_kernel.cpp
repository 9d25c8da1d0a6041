// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/row_kernel.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cmodel/fast/row_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::cmodel::fast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

bool add16(const FastPlan&, std::span<const SplatJob>, std::uint16_t*, std::size_t) { return false; }
bool add32(const FastPlan&, std::span<const SplatJob>, std::uint32_t*, std::size_t) { return false; }
void hidden(const FastPlan&, const HiddenJob&, std::span<const HiddenShare>, const Planes&) {}
const char* target() { return nullptr; }

#else

#include "cmodel/fast/spread.inc"

struct Lanes16 {
  using D = hn::ScalableTag<std::uint16_t>;
  static hn::Vec<D> colour(const SplatJob& job) {
    return hn::BitCast(D{}, hn::Set(hn::Repartition<std::uint64_t, D>{}, [&] {
                         std::uint64_t all = 0;
                         for (std::size_t c = 4; c-- > 0;) all = (all << 16) | job.colour[c];
                         return all;
                       }()));
  }
  explicit Lanes16(const FastPlan&) {}
  hn::Vec<D> sum(hn::Vec<D> before, hn::Vec<D> colour, hn::Vec<D> weight) const {
    const hn::RebindToSigned<D> s;
    const auto product = hn::MulFixedPoint15(hn::BitCast(s, colour), hn::BitCast(s, weight));
    return hn::SaturatedAdd(before, hn::BitCast(D{}, product));
  }
  bool sound() const { return true; }
};

struct Lanes32 {
  using D = hn::ScalableTag<std::uint32_t>;
  static hn::Vec<D> colour(const SplatJob& job) {
    HWY_ALIGN std::uint32_t words[4] = {job.colour[0], job.colour[1], job.colour[2], job.colour[3]};
    return hn::LoadDup128(D{}, words);
  }
  explicit Lanes32(const FastPlan& plan) : bias(hn::Set(D{}, plan.bias)), dropped(plan.dropped_bits) {}
  hn::Vec<D> sum(hn::Vec<D> before, hn::Vec<D> colour, hn::Vec<D> weight) const {
    return hn::Add(before, hn::ShiftRightSame(hn::Add(hn::Mul(colour, weight), bias), dropped));
  }
  bool sound() const { return true; }
  hn::Vec<D> bias;
  int dropped;
};

/// The same, with a check for sums that wrap.
struct Carries32 : Lanes32 {
  explicit Carries32(const FastPlan& plan) : Lanes32(plan), lost(hn::Zero(D{})) {}
  hn::Vec<D> sum(hn::Vec<D> before, hn::Vec<D> colour, hn::Vec<D> weight) {
    const auto after = Lanes32::sum(before, colour, weight);
    lost = hn::Or(lost, hn::Xor(hn::Max(after, before), after));
    return after;
  }
  bool sound() const { return hn::AllTrue(D{}, hn::Eq(lost, hn::Zero(D{}))); }
  hn::Vec<D> lost;
};

template <class Lanes, std::size_t kVectors, class T>
void add_rows(const SplatJob& job, T* sheet, std::size_t row, Lanes& lanes, const Spread<typename Lanes::D>& spread) {
  const typename Lanes::D d;
  constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(T);
  const auto colour = Lanes::colour(job);
  const std::size_t pitch = pitch_of(job.columns);
  T* out = sheet + std::size_t{job.at} * 4;
  const std::uint16_t* weights = job.weights;
  for (std::size_t j = 0; j < job.rows; ++j, out += row * 4, weights += pitch) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      const std::size_t block = v / Spread<typename Lanes::D>::kVectors;
      const auto eight =
          hn::BitCast(d, hn::LoadDup128(hn::Repartition<std::uint16_t, typename Lanes::D>{}, weights + 8 * block));
      T* at = out + v * kLanes;
      const auto weight = spread(eight, v % Spread<typename Lanes::D>::kVectors);
      hn::StoreU(lanes.sum(hn::LoadU(d, at), colour, weight), d, at);
    }
  }
}

/// The `count` vectors of eight weights.
template <class Lanes, class T>
HWY_INLINE void add_eight(const std::uint16_t* weights, T* out, hn::Vec<typename Lanes::D> colour, Lanes& lanes,
                          const Spread<typename Lanes::D>& spread, std::size_t count) {
  const typename Lanes::D d;
  constexpr std::size_t kLanes = HWY_MAX_BYTES / sizeof(T);
  const auto eight = hn::BitCast(d, hn::LoadDup128(hn::Repartition<std::uint16_t, typename Lanes::D>{}, weights));
  for (std::size_t v = 0; v < count; ++v) {
    T* at = out + v * kLanes;
    hn::StoreU(lanes.sum(hn::LoadU(d, at), colour, spread(eight, v)), d, at);
  }
}

template <class Lanes, class T>
void add_wide(const SplatJob& job, T* sheet, std::size_t row, Lanes& lanes, const Spread<typename Lanes::D>& spread,
              std::size_t vectors) {
  constexpr std::size_t kEach = Spread<typename Lanes::D>::kVectors;
  const auto colour = Lanes::colour(job);
  const std::size_t pitch = pitch_of(job.columns), whole = vectors / kEach, rest = vectors % kEach;
  for (std::size_t j = 0; j < job.rows; ++j) {
    T* out = sheet + (job.at + j * row) * 4;
    const std::uint16_t* weights = job.weights + j * pitch;
    for (std::size_t block = 0; block < whole; ++block, weights += 8, out += 8 * 4)
      add_eight(weights, out, colour, lanes, spread, kEach);
    if (rest != 0) add_eight(weights, out, colour, lanes, spread, rest);
  }
}

template <class Lanes, class T>
bool add_all(const FastPlan& plan, std::span<const SplatJob> jobs, T* sheet, std::size_t row) {
  Lanes lanes(plan);
  const Spread<typename Lanes::D> spread;
  constexpr std::size_t kPixels = HWY_MAX_BYTES / sizeof(T) / 4;
  for (const SplatJob& job : jobs) {
    const std::size_t vectors = (job.columns + kPixels - 1) / kPixels;
    switch (vectors) {
      case 0:
        break;
      case 1:
        add_rows<Lanes, 1>(job, sheet, row, lanes, spread);
        break;
      case 2:
        add_rows<Lanes, 2>(job, sheet, row, lanes, spread);
        break;
      case 3:
        add_rows<Lanes, 3>(job, sheet, row, lanes, spread);
        break;
      case 4:
        add_rows<Lanes, 4>(job, sheet, row, lanes, spread);
        break;
      case 5:
        add_rows<Lanes, 5>(job, sheet, row, lanes, spread);
        break;
      case 6:
        add_rows<Lanes, 6>(job, sheet, row, lanes, spread);
        break;
      default:
        add_wide<Lanes>(job, sheet, row, lanes, spread, vectors);
        break;
    }
  }
  return lanes.sound();
}

bool add16(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint16_t* sheet, std::size_t row) {
  return add_all<Lanes16>(plan, jobs, sheet, row);
}
bool add32(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint32_t* sheet, std::size_t row) {
  return plan.carries ? add_all<Carries32>(plan, jobs, sheet, row) : add_all<Lanes32>(plan, jobs, sheet, row);
}
// Rows of weights are padded to 8 words, so no vector is wider than 8 pixels here.
void hidden(const FastPlan& plan, const HiddenJob& job, std::span<const HiddenShare> shares, const Planes& planes) {
  const hn::CappedTag<std::uint16_t, 8> d;
  const hn::RebindToSigned<decltype(d)> s;
  const std::size_t pitch = pitch_of(job.columns);
  const int down = std::max(0, plan.hidden_shift), up = std::max(0, -plan.hidden_shift);
  // Narrow plans give the device's own products; otherwise add what rounding may have taken off, and a little more.
  const auto lost = hn::Set(d, static_cast<std::uint16_t>(plan.narrow ? 0 : 1));
  std::size_t plane = planes.first;
  for (const HiddenShare& share : shares) {
    std::uint16_t* out = planes.words + plane * planes.pixels + job.at;
    if (++plane == planes.count) plane = 0;
    if (share.word == 0) continue;
    const std::uint32_t word = ((share.word + (1U << down) - 1) >> down) << up;
    const auto colour = hn::BitCast(s, hn::Set(d, static_cast<std::uint16_t>(word)));
    const std::uint16_t* weights = job.weights;
    for (std::size_t j = 0; j < job.rows; ++j, out += planes.row, weights += pitch) {
      for (std::size_t i = 0; i < job.columns; i += hn::Lanes(d)) {
        const auto product = hn::MulFixedPoint15(colour, hn::BitCast(s, hn::LoadU(d, weights + i)));
        const auto most = hn::Add(hn::BitCast(d, product), lost);
        hn::StoreU(hn::SaturatedAdd(hn::LoadU(d, out + i), most), d, out + i);
      }
    }
  }
}
const char* target() { return hwy::TargetName(HWY_TARGET); }

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::cmodel::fast
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::cmodel::fast {
HWY_EXPORT(add16);
HWY_EXPORT(add32);
HWY_EXPORT(hidden);
HWY_EXPORT(target);

bool add_splats(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint16_t* sheet, std::size_t row) {
  return HWY_DYNAMIC_DISPATCH(add16)(plan, jobs, sheet, row);
}
bool add_splats(const FastPlan& plan, std::span<const SplatJob> jobs, std::uint32_t* sheet, std::size_t row) {
  return HWY_DYNAMIC_DISPATCH(add32)(plan, jobs, sheet, row);
}
void add_hidden(const FastPlan& plan, const HiddenJob& job, std::span<const HiddenShare> shares, const Planes& planes) {
  HWY_DYNAMIC_DISPATCH(hidden)(plan, job, shares, planes);
}
bool has_vectors() { return vector_target() != nullptr; }
const char* vector_target() { return HWY_DYNAMIC_DISPATCH(target)(); }
}  // namespace fastsplat::cmodel::fast
#endif
