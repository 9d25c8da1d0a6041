// SPDX-License-Identifier: Apache-2.0
#include "tools/benchmarks/rmw_loop.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tools/benchmarks/rmw_loop.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fastsplat::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void rmw_all(std::span<const std::uint32_t> places, std::size_t rows, std::uint16_t* memory) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const auto one = hn::Set(d, std::uint16_t{1});
  for (const std::uint32_t place : places) {
    std::uint16_t* row = memory + place;
    for (std::size_t j = 0; j < rows; ++j, row += kRmwRow / 2) {
      for (std::size_t i = 0; i < 32; i += hn::Lanes(d)) hn::StoreU(hn::Add(hn::LoadU(d, row + i), one), d, row + i);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fastsplat::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fastsplat::bench {
HWY_EXPORT(rmw_all);
void rmw(std::span<const std::uint32_t> places, std::size_t rows, std::uint16_t* memory) {
  HWY_DYNAMIC_DISPATCH(rmw_all)(places, rows, memory);
}
}  // namespace fastsplat::bench
#endif
