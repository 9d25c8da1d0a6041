// SPDX-License-Identifier: Apache-2.0
#include "golden/splat_tree.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace fastsplat::golden {

namespace {
constexpr std::uint32_t kLeafSplats = 32;

/// A word that sorts like (place, index): indices break ties, and -0 equals 0.
std::uint64_t ordered(float place, std::uint32_t index) {
  const auto bits = std::bit_cast<std::uint32_t>(place + 0.0f);
  const std::uint32_t rising = bits >> 31 != 0 ? ~bits : bits | 0x80000000u;
  return std::uint64_t{rising} << 32 | index;
}
}  // namespace

SplatTree::SplatTree(const std::vector<scene::Splat>& splats) : order_(splats.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<std::uint64_t> words(splats.size());
  if (!splats.empty()) build(splats, words, 0, static_cast<std::uint32_t>(splats.size()));
}

void SplatTree::build(const std::vector<scene::Splat>& splats, std::vector<std::uint64_t>& words, std::uint32_t begin,
                      std::uint32_t end) {
  glm::vec3 low = splats[order_[begin]].position;
  glm::vec3 high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    low = glm::min(low, splats[order_[i]].position);
    high = glm::max(high, splats[order_[i]].position);
  }
  const std::size_t self = nodes_.size();
  Node node;
  node.centre = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
  node.radius = 0.5 * glm::length(glm::dvec3(high) - glm::dvec3(low));
  nodes_.push_back(node);

  if (end - begin <= kLeafSplats) {
    nodes_[self].begin = begin;
    nodes_[self].end = end;
    std::sort(order_.begin() + begin, order_.begin() + end);
  } else {
    // Halve along the longest side. Indices break ties in position, so the tree does not depend on the library. The
    // sorted words hold both and are contiguous in memory.
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    for (std::uint32_t i = begin; i < end; ++i) words[i] = ordered(splats[order_[i]].position[axis], order_[i]);
    std::nth_element(words.begin() + begin, words.begin() + middle, words.begin() + end);
    for (std::uint32_t i = begin; i < end; ++i) order_[i] = static_cast<std::uint32_t>(words[i]);
    build(splats, words, begin, middle);
    build(splats, words, middle, end);
  }
  nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace fastsplat::golden
