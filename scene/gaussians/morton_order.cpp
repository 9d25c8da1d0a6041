// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/morton_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
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
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Gaussian& one : cloud.gaussians)
    low = glm::min(low, glm::dvec3(one.position)), high = glm::max(high, glm::dvec3(one.position));
  std::vector<std::uint64_t> codes(cloud.gaussians.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    constexpr double kMost = (1 << 21) - 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double size = high[axis] - low[axis];
      const double share =
          size > 0.0 ? (static_cast<double>(cloud.gaussians[i].position[axis]) - low[axis]) / size : 0.0;
      codes[i] |= spread(static_cast<std::uint64_t>(share * kMost)) << static_cast<unsigned>(axis);
    }
  }
  std::vector<std::size_t> order(codes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&codes](std::size_t i) { return codes[i]; });
  return order;
}

}  // namespace fastsplat::scene
