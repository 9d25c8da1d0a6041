#include "golden/splat_tree.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace fastsplat::golden {

namespace {
constexpr std::uint32_t kLeafSplats = 32;
}

SplatTree::SplatTree(const std::vector<scene::Splat>& splats) : order_(splats.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!splats.empty()) build(splats, 0, static_cast<std::uint32_t>(splats.size()));
}

void SplatTree::build(const std::vector<scene::Splat>& splats, std::uint32_t begin, std::uint32_t end) {
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
    // Halve along the longest side. Ties in position are broken by index: the tree must not depend on the library.
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(splats[a].position[axis], a) < std::pair(splats[b].position[axis], b);
    };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, before);
    build(splats, begin, middle);
    build(splats, middle, end);
  }
  nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace fastsplat::golden
