// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/matched_gaussians.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace fastsplat::analysis {
namespace {

using scene::GaussianCloud;

constexpr std::size_t kNearest = 16;

double squared_distance(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 apart = glm::dvec3(a) - glm::dvec3(b);
  return glm::dot(apart, apart);
}

/// Points by position: a k-d tree in an array, the median of each part in its middle.
class NearPoints {
 public:
  struct Found {
    double squared = 0.0;
    std::uint32_t number = 0;
  };

  explicit NearPoints(const GaussianCloud& cloud) : cloud_(cloud), order_(cloud.gaussians.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    build(order_, 0);
  }
  /// The `kNearest` nearest, nearest first.
  std::vector<Found> near(const glm::vec3& at) const {
    std::vector<Found> found;
    search(order_, 0, at, found);
    return found;
  }

 private:
  float along(std::uint32_t number, int axis) const { return cloud_.gaussians[number].position[axis]; }

  void build(std::span<std::uint32_t> part, int axis) {
    if (part.size() < 2) return;
    const std::size_t middle = part.size() / 2;
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return along(a, axis) < along(b, axis); });
    build(part.first(middle), (axis + 1) % 3);
    build(part.subspan(middle + 1), (axis + 1) % 3);
  }

  void search(std::span<const std::uint32_t> part, int axis, const glm::vec3& at, std::vector<Found>& found) const {
    if (part.empty()) return;
    const std::size_t middle = part.size() / 2;
    const double beside = static_cast<double>(at[axis]) - static_cast<double>(along(part[middle], axis));
    const auto before = part.first(middle), behind = part.subspan(middle + 1);
    search(beside < 0.0 ? before : behind, (axis + 1) % 3, at, found);
    const Found here{squared_distance(at, cloud_.gaussians[part[middle]].position), part[middle]};
    const auto place = std::upper_bound(found.begin(), found.end(), here.squared,
                                        [](double squared, const Found& one) { return squared < one.squared; });
    found.insert(place, here);
    if (found.size() > kNearest) found.pop_back();
    if (found.size() < kNearest || beside * beside <= found.back().squared)
      search(beside < 0.0 ? behind : before, (axis + 1) % 3, at, found);
  }

  const GaussianCloud& cloud_;
  std::vector<std::uint32_t> order_;
};

/// How unlike two Gaussians are, apart from their places.
double unlike(const GaussianCloud& from, std::size_t a, const GaussianCloud& to, std::size_t b) {
  const scene::Gaussian &x = from.gaussians[a], &y = to.gaussians[b];
  double sum = std::abs(static_cast<double>(x.opacity - y.opacity));
  std::array<float, 3> p{x.scale.x, x.scale.y, x.scale.z}, q{y.scale.x, y.scale.y, y.scale.z};
  std::ranges::sort(p), std::ranges::sort(q);  // encoders may exchange axes
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += std::abs(
        std::log(std::max(static_cast<double>(p[axis]), 1e-10) / std::max(static_cast<double>(q[axis]), 1e-10)));
  return sum + glm::distance(glm::dvec3(from.harmonics_of(a)[0]), glm::dvec3(to.harmonics_of(b)[0]));
}

}  // namespace

std::vector<std::optional<std::uint32_t>> matched_gaussians(const GaussianCloud& from, const GaussianCloud& to) {
  struct Choice {
    float cost = 0.0F;
    std::uint32_t number = 0;
  };
  const NearPoints points(to);
  const std::size_t count = from.gaussians.size();
  std::vector<std::vector<Choice>> choices(count);  // the best last
  std::size_t in_order = 0;
  for (std::size_t i = 0; i < count; ++i) {
    auto near = points.near(from.gaussians[i].position);
    // More than the nearest may lie in one place.
    if (i < to.gaussians.size()) {
      const double own = squared_distance(from.gaussians[i].position, to.gaussians[i].position);
      const bool known = std::ranges::any_of(near, [i](const auto& one) { return one.number == i; });
      if (!known && own <= near.back().squared) near.push_back({own, static_cast<std::uint32_t>(i)});
    }
    // Places count in units of the distance to the last of the nearest.
    const double unit = near.back().squared > 0.0 ? near.back().squared : 1.0;
    for (const auto& [squared, number] : near) {
      in_order += number == i ? 1U : 0U;
      choices[i].push_back({static_cast<float>(squared / unit + unlike(from, i, to, number)), number});
    }
    std::ranges::stable_sort(choices[i], [](const Choice& a, const Choice& b) { return a.cost > b.cost; });
  }
  std::vector<std::optional<std::uint32_t>> out(count);
  constexpr double kMost = 0.9;
  if (count == to.gaussians.size() && static_cast<double>(in_order) > kMost * static_cast<double>(count)) {
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<std::uint32_t>(i);
    return out;
  }
  // Stable matching (Gale and Shapley): each asks for its next choice; who is asked keeps the more alike.
  std::vector<Choice> holder(to.gaussians.size());  // its cost and who holds it, if held
  std::vector<char> held(to.gaussians.size(), 0);
  for (std::size_t first = 0; first < count; ++first) {
    for (std::size_t i = first; !choices[i].empty();) {
      const auto [cost, number] = choices[i].back();
      choices[i].pop_back();
      if (held[number] != 0 && !(cost < holder[number].cost)) continue;
      const std::size_t before = holder[number].number;
      const bool free = held[number] == 0;
      held[number] = 1, holder[number] = {cost, static_cast<std::uint32_t>(i)};
      out[i] = number;
      if (free) break;
      out[before].reset();
      i = before;
    }
  }
  return out;
}

}  // namespace fastsplat::analysis
