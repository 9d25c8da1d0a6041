// Eight weights to the pixels of vectors, once for each kind of vector (Highway's way of sharing code among kernels).
#if defined(FASTSPLAT_CMODEL_FAST_SPREAD) == defined(HWY_TARGET_TOGGLE)
#ifdef FASTSPLAT_CMODEL_FAST_SPREAD
#undef FASTSPLAT_CMODEL_FAST_SPREAD
#else
#define FASTSPLAT_CMODEL_FAST_SPREAD
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::cmodel::fast {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// Of 8 weights in every 128-bit block, the ones of vector v's pixels, each in the four lanes of its pixel.
template <class D>
class Spread {
 public:
  using T = hn::TFromD<D>;
  using Bytes = hn::Repartition<std::uint8_t, D>;
  static constexpr std::size_t kBytes = HWY_MAX_BYTES;
  static constexpr std::size_t kVectors = 8 * 4 / (HWY_MAX_BYTES / sizeof(T));  // of 8 pixels

  Spread() {
    for (std::size_t v = 0; v < kVectors; ++v) {
      for (std::size_t i = 0; i < kBytes; ++i) {
        const std::size_t pixel = (v * (kBytes / sizeof(T)) + i / sizeof(T)) / 4, byte = i % sizeof(T);
        index_[v * kBytes + i] = static_cast<std::uint8_t>(byte < 2 ? 2 * pixel + byte : 0x80);
      }
    }
  }
  template <class V>
  V operator()(V weights, std::size_t vector) const {
    const Bytes bytes;
    const auto index = hn::Load(bytes, index_ + vector * kBytes);
    return hn::BitCast(D{}, hn::TableLookupBytesOr0(hn::BitCast(bytes, weights), index));
  }

 private:
  HWY_ALIGN std::uint8_t index_[kVectors * kBytes];
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::cmodel::fast
HWY_AFTER_NAMESPACE();

#endif
