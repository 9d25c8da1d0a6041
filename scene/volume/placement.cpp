// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace fastsplat::volume {
namespace {

constexpr double kStraight = 1e-4;  // of a unit vector: 1/40 of a voxel over 256

/// Which grid axis of the file runs along x, y and z of the volume, and whether it is flipped.
struct Order {
  std::array<int, 3> axis{0, 1, 2};
  std::array<bool, 3> flipped{false, false, false};
  bool operator==(const Order&) const = default;
};

double degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

/// The order that aligns the axes best with the world's, in total.
Order nearest_order(const std::array<glm::dvec3, 3>& unit) {
  std::array<int, 3> axis{0, 1, 2};
  Order best;
  double most = -1.0;
  do {
    double along = 0.0;
    for (int world = 0; world < 3; ++world) along += std::abs(unit[static_cast<std::size_t>(axis[world])][world]);
    if (along > most + 1e-9) most = along, best.axis = axis;
  } while (std::next_permutation(axis.begin(), axis.end()));
  for (int world = 0; world < 3; ++world) {
    const auto slot = static_cast<std::size_t>(world);
    best.flipped[slot] = unit[static_cast<std::size_t>(best.axis[slot])][world] < 0.0;
  }
  return best;
}

void reorder(Volume& volume, const Order& order) {
  if (order == Order{}) return;
  Volume turned = volume;
  for (int a = 0; a < 3; ++a) {
    turned.dims[a] = volume.dims[order.axis[static_cast<std::size_t>(a)]];
    turned.spacing[a] = volume.spacing[order.axis[static_cast<std::size_t>(a)]];
  }
  if (!volume.voxels.empty()) {
    auto out = turned.voxels.begin();
    glm::ivec3 from;
    for (int k = 0; k < turned.dims.z; ++k) {
      for (int j = 0; j < turned.dims.y; ++j) {
        for (int i = 0; i < turned.dims.x; ++i) {
          const glm::ivec3 to(i, j, k);
          for (int a = 0; a < 3; ++a) {
            const auto slot = static_cast<std::size_t>(a);
            from[order.axis[slot]] = order.flipped[slot] ? turned.dims[a] - 1 - to[a] : to[a];
          }
          *out++ = volume.at(from.x, from.y, from.z);
        }
      }
    }
  }
  volume = std::move(turned);
}

}  // namespace

bool spans_space(const std::array<glm::dvec3, 3>& direction) {
  std::array<glm::dvec3, 3> unit;
  for (std::size_t a = 0; a < 3; ++a) {
    const double length = glm::length(direction[a]);
    if (!(length > 1e-9 && length < 1e9)) return false;
    unit[a] = direction[a] / length;
  }
  return std::abs(glm::determinant(glm::dmat3(unit[0], unit[1], unit[2]))) > 1e-3;
}

void place(Volume& volume, const Placement& placement) {
  std::array<glm::dvec3, 3> unit;
  glm::dvec3 centre = placement.origin;
  for (int a = 0; a < 3; ++a) {
    const auto slot = static_cast<std::size_t>(a);
    unit[slot] = glm::normalize(placement.direction[slot]);
    centre += 0.5 * (volume.dims[a] - 1) * volume.spacing[a] * unit[slot];
  }
  const Order order = nearest_order(unit);
  reorder(volume, order);
  glm::dmat3 axes(1.0);
  for (int a = 0; a < 3; ++a) {
    const auto slot = static_cast<std::size_t>(a);
    axes[a] = (order.flipped[slot] ? -1.0 : 1.0) * unit[static_cast<std::size_t>(order.axis[slot])];
  }
  double aside = 0.0;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) aside = std::max(aside, std::abs(axes[a][b] - (a == b ? 1.0 : 0.0)));
  }
  if (aside > kStraight) volume.turn(axes);
  volume.placed = true;
  volume.centre = placement.has_origin ? centre : glm::dvec3(0.0);
}

Turn turn_of(const Volume& volume) {
  Turn turn;
  if (!volume.oblique) return turn;
  const glm::dmat3& m = volume.axes;
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
    turn.shear = std::max(turn.shear, degrees(std::asin(std::min(1.0, std::abs(glm::dot(m[a], m[b]))))));
  // Twice the sine of the angle times its axis, and twice the cosine plus one, of the nearest rotation's matrix.
  const glm::dvec3 curl(m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]);
  turn.degrees = degrees(std::atan2(glm::length(curl), m[0][0] + m[1][1] + m[2][2] - 1.0));
  if (glm::length(curl) > 1e-9) turn.about = glm::normalize(curl);
  return turn;
}

}  // namespace fastsplat::volume
