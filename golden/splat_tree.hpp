// SPDX-License-Identifier: Apache-2.0
// Finds the kernels that a ray passes through: a tree of bounding balls over the splats' centres.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/splats.hpp"

namespace fastsplat::golden {

class SplatTree {
 public:
  explicit SplatTree(const std::vector<scene::Splat>& splats);

  /// Splat indices in the order of visits.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls visit(place) for every splat whose centre is within `distance` of the line and between two planes, low <=
  /// dot(centre, axis) <= high. May visit others nearby; the order is always the same. `axis` is a unit vector, `place`
  /// the splat's index in order().
  template <class Visit>
  void near_line_between(const glm::dvec3& origin, const glm::dvec3& unit_direction, double distance,
                         const glm::dvec3& axis, double low, double high, Visit&& visit) const {
    for (std::size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      const glm::dvec3 to_centre = node.centre - origin;
      const double along = glm::dot(to_centre, unit_direction);
      const double reach = node.radius + distance;
      const double depth = glm::dot(node.centre, axis);
      if (glm::dot(to_centre, to_centre) - along * along > reach * reach || depth + node.radius < low ||
          depth - node.radius > high) {
        n = node.skip;
        continue;
      }
      for (std::uint32_t i = node.begin; i < node.end; ++i) visit(i);
      ++n;
    }
  }

 private:
  /// Nodes lie in depth-first order; `skip` is the next node outside this one's subtree. Only leaves hold splats.
  struct Node {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
    std::uint32_t skip = 0;
    std::uint32_t begin = 0, end = 0;
  };
  /// `words`: scratch space, one word per splat.
  void build(const std::vector<scene::Splat>& splats, std::vector<std::uint64_t>& words, std::uint32_t begin,
             std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace fastsplat::golden
