// SPDX-License-Identifier: Apache-2.0
#include "golden/add_footprint.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "golden/add_footprint.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::golden {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// All four sums of a pixel at once if vectors hold four, else in parts. Wider vectors would take two pixels. But
// footprints are only a few pixels wide and begin anywhere: crossed cache lines cost what fewer instructions save.
#if HWY_TARGET == HWY_SCALAR
using Part = hn::CappedTag<double, 1>;
#elif HWY_MAX_BYTES < 32
using Part = hn::CappedTag<double, 2>;
#else
using Part = hn::CappedTag<double, 4>;
#endif
constexpr std::size_t kLanes = HWY_TARGET == HWY_SCALAR ? 1 : HWY_MAX_BYTES < 32 ? 2 : 4;
constexpr std::size_t kParts = 4 / kLanes;

/// kSheets sheets at once, so each weight is loaded once.
template <std::size_t kSheets>
void add_to(const Footprint& footprint, int first_row, std::size_t pitch, const Sums* values, Sums* const* sheets) {
  const Part d;
  hn::Vec<Part> value[kSheets][kParts];
  for (std::size_t s = 0; s < kSheets; ++s) {
    for (std::size_t part = 0; part < kParts; ++part) value[s][part] = hn::LoadU(d, values[s].data() + part * kLanes);
  }
  for (const Footprint::Span& span : footprint.spans()) {
    const double* weights = footprint.weights(span);
    const std::size_t first =
        4 * (static_cast<std::size_t>(span.y - first_row) * pitch + static_cast<std::size_t>(span.x));
    double* sums[kSheets];
    for (std::size_t s = 0; s < kSheets; ++s) sums[s] = sheets[s]->data() + first;
    for (std::size_t i = 0; i < static_cast<std::size_t>(span.width); ++i) {
      const auto weight = hn::Set(d, weights[i]);
      for (std::size_t s = 0; s < kSheets; ++s) {
        for (std::size_t part = 0; part < kParts; ++part) {
          double* at = sums[s] + 4 * i + part * kLanes;
          hn::StoreU(hn::Add(hn::LoadU(d, at), hn::Mul(weight, value[s][part])), d, at);
        }
      }
    }
  }
}

void add_all(const Footprint& footprint, int first_row, std::size_t pitch, const Sums* values, Sums* const* sheets,
             std::size_t count) {
  for (; count >= 4; values += 4, sheets += 4, count -= 4) add_to<4>(footprint, first_row, pitch, values, sheets);
  switch (count) {
    case 3:
      return add_to<3>(footprint, first_row, pitch, values, sheets);
    case 2:
      return add_to<2>(footprint, first_row, pitch, values, sheets);
    case 1:
      return add_to<1>(footprint, first_row, pitch, values, sheets);
    default:
      return;
  }
}
const char* target() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::golden
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::golden {
HWY_EXPORT(add_all);
HWY_EXPORT(target);

void add_footprint(const Footprint& footprint, int first_row, std::size_t pitch, std::span<const Sums> values,
                   std::span<Sums* const> sheets) {
  HWY_DYNAMIC_DISPATCH(add_all)(footprint, first_row, pitch, values.data(), sheets.data(), values.size());
}
const char* add_footprint_target() { return HWY_DYNAMIC_DISPATCH(target)(); }
}  // namespace fastsplat::golden
#endif
