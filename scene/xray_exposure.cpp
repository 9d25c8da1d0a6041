// SPDX-License-Identifier: Apache-2.0
#include "scene/xray_exposure.hpp"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace fastsplat::scene {
namespace {

/// One of each pair of opposite neighbours: the one later in memory.
constexpr std::array<glm::ivec3, 13> kDirections = {{{1, 0, 0},
                                                     {-1, 1, 0},
                                                     {0, 1, 0},
                                                     {1, 1, 0},
                                                     {-1, -1, 1},
                                                     {0, -1, 1},
                                                     {1, -1, 1},
                                                     {-1, 0, 1},
                                                     {0, 0, 1},
                                                     {1, 0, 1},
                                                     {-1, 1, 1},
                                                     {0, 1, 1},
                                                     {1, 1, 1}}};

/// Sums along the lines of one direction, up to and including each voxel of a slice z; border cells stay 0.
class Lines {
 public:
  Lines(const glm::ivec3& direction, const glm::ivec3& dims)
      : direction_(direction),
        dims_(dims),
        pitch_(static_cast<std::size_t>(dims.x) + 2),
        before_(pitch_ * (static_cast<std::size_t>(dims.y) + 2)),
        now_(before_) {}

  /// `row`: extinctions of the voxels (0.., y, z). Call in the order of memory.
  void add(int y, const float* row) {
    const std::vector<double>& from = direction_.z == 0 ? now_ : before_;
    const double* last = from.data() + at(y - direction_.y) - direction_.x;
    double* sums = now_.data() + at(y);
    for (int x = 0; x < dims_.x; ++x) sums[x] = last[x] + static_cast<double>(row[x]);
    for (int x = 0; x < dims_.x; ++x) largest_ = std::max(largest_, sums[x]);
  }
  void end_slice() { std::swap(before_, now_); }
  double largest() const { return largest_; }

 private:
  std::size_t at(int y) const { return (static_cast<std::size_t>(y) + 1) * pitch_ + 1; }

  glm::ivec3 direction_, dims_;
  std::size_t pitch_;
  std::vector<double> before_, now_;
  double largest_ = 0.0;
};

/// Distance from a voxel to its neighbour, in kernel units.
double step(const volume::Volume& volume, const glm::ivec3& d) {
  const glm::dvec3 from = volume.position(0, 0, 0), to = volume.position(d.x, d.y, d.z);
  return glm::length(to - from) / volume.kernel_unit();
}

}  // namespace

double densest_line(const volume::Volume& volume, const Classifier& classify) {
  const glm::ivec3 dims = volume.dims;
  std::vector<Lines> lines;
  for (const glm::ivec3& direction : kDirections) lines.emplace_back(direction, dims);
  std::vector<float> row(static_cast<std::size_t>(dims.x));
  auto value = volume.voxels.begin();
  for (int z = 0; z < dims.z; ++z) {
    for (int y = 0; y < dims.y; ++y) {
      for (float& extinction : row) extinction = classify(*value++).extinction;
      for (Lines& one : lines) one.add(y, row.data());
    }
    for (Lines& one : lines) one.end_slice();
  }
  double densest = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    densest = std::max(densest, lines[i].largest() * step(volume, kDirections[i]));
  return densest;
}

double automatic_exposure(const volume::Volume& volume, const Classifier& classify, double opacity_scale) {
  constexpr double kRipple = 1.05;  // upper bound for the named kernels: 4.38 % at a = 2
  const double densest = densest_line(volume, classify);
  return densest > 0.0 ? 1.0 / (kRipple * densest * opacity_scale) : 1.0;
}

}  // namespace fastsplat::scene
