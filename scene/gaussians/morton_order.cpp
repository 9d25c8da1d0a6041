// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/morton_order.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace fastsplat::scene {
namespace {

/// Two zero bits before each of 21 bits.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x001F00000000FFFFULL;
  bits = (bits | bits << 16U) & 0x001F0000FF0000FFULL;
  bits = (bits | bits << 8U) & 0x100F00F00F00F00FULL;
  bits = (bits | bits << 4U) & 0x10C30C30C30C30C3ULL;
  return (bits | bits << 2U) & 0x1249249249249249ULL;
}

}  // namespace

std::vector<std::size_t> morton_order(const GaussianCloud& cloud) {
  std::vector<std::uint64_t> codes(cloud.gaussians.size());
  std::vector<float> sorted(codes.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(cloud.gaussians, sorted.begin(), [axis](const Gaussian& one) { return one.position[axis]; });
    std::ranges::sort(sorted);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      constexpr std::uint64_t kSteps = std::uint64_t{1} << 21U;
      const auto rank =
          std::lower_bound(sorted.begin(), sorted.end(), cloud.gaussians[i].position[axis]) - sorted.begin();
      codes[i] |= spread(static_cast<std::uint64_t>(rank) * kSteps / sorted.size()) << static_cast<unsigned>(axis);
    }
  }
  std::vector<std::size_t> order(codes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&codes](std::size_t i) { return codes[i]; });
  return order;
}

}  // namespace fastsplat::scene
