// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/share_kernel.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "driver/tiles/share_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::driver {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void shares(const SheetCut&, int, const WaitingSplat*, std::size_t, SheetColour*) {}

#else

using Words = hn::CappedTag<std::uint32_t, 4>;
using V = hn::Vec<Words>;
constexpr Words d;

/// 1.0 would take 33 bits. One less gives the same parts: words of U 4.cf are below 2^31.
std::uint32_t factor(std::uint64_t phi) { return static_cast<std::uint32_t>(std::min<std::uint64_t>(phi, ~0U)); }

/// Slices::part of four words.
V part(const V& words, const V& odd_words, std::uint32_t phi) {
  const hn::RepartitionToWide<Words> wide;
  const V factor = hn::Set(d, phi);
  const auto half = hn::Set(wide, std::uint64_t{1} << 31);
  const auto even = hn::Add(hn::MulEven(words, factor), half), odd = hn::Add(hn::MulEven(odd_words, factor), half);
  return hn::OddEven(hn::BitCast(d, odd), hn::BitCast(d, hn::ShiftRight<32>(even)));
}
V share(const SplatWords& words, std::uint32_t near, std::uint32_t far) {
  const hn::RepartitionToWide<Words> wide;
  const V all = hn::LoadU(d, words.data()), odd = hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(wide, all)));
  return hn::Sub(part(all, odd, far), part(all, odd, near));
}
void shares(const SheetCut& cut, int colour_shift, const WaitingSplat* splats, std::size_t count, SheetColour* out) {
  const hn::Rebind<std::uint16_t, Words> narrow;
  const V largest = hn::Set(d, cut.largest);
  for (std::size_t i = 0; i < count; ++i) {
    const WaitingSplat& splat = splats[i];
    std::uint32_t near = 0, far = ~0U;
    if (cut.phi != nullptr) {
      near = factor(cut.phi[std::clamp(cut.near - splat.depth, 0, cut.last)]);
      far = factor(cut.phi[std::clamp(cut.far - splat.depth, 0, cut.last)]);
    }
    const V exact = share(splat.words, near, far), kept = hn::Min(exact, largest);
    hn::StoreU(hn::TruncateTo(narrow, hn::ShiftLeftSame(kept, colour_shift)), narrow, out[i].words.data());
    out[i].empty = hn::AllTrue(d, hn::Eq(exact, hn::Zero(d)));
    out[i].saturated = !hn::AllTrue(d, hn::Eq(exact, kept));
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::driver
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::driver {
HWY_EXPORT(shares);

void share_out(const SheetCut& cut, int colour_shift, const WaitingSplat* splats, std::size_t count, SheetColour* out) {
  HWY_DYNAMIC_DISPATCH(shares)(cut, colour_shift, splats, count, out);
}
}  // namespace fastsplat::driver
#endif
