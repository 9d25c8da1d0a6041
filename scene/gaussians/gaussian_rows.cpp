// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gaussian_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::size_t kMostNamed = 4;  // causes in a remark

std::string fault_of_rotation(const glm::dvec4& rotation) {
  for (int i = 0; i < 4; ++i)
    if (!std::isfinite(rotation[i])) return fmt::format("rot_{} is not finite", i);
  const double length = glm::length(rotation);
  return length > 0.0 && std::isfinite(length) ? "" : "rotation (rot_0 to rot_3) is zero or too large";
}

/// Name of the property for channel `c` of harmonic `i`; a channel has `count` harmonics.
std::string harmonic_name(std::size_t i, int c, std::size_t count) {
  return i == 0 ? fmt::format("f_dc_{}", c)
                : fmt::format("f_rest_{}", static_cast<std::size_t>(c) * (count - 1) + i - 1);
}

}  // namespace

std::string fault_of(const Gaussian& gaussian, std::span<const glm::vec3> harmonics) {
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(gaussian.position[axis])) return fmt::format("{} is not finite", "xyz"[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(gaussian.scale[axis])) return fmt::format("scale_{} is not finite", axis);
    if (gaussian.scale[axis] < 0.0F) return fmt::format("scale_{} is negative", axis);
  }
  if (std::isnan(gaussian.opacity)) return "opacity is not a number";
  if (gaussian.opacity < 0.0F || gaussian.opacity > 1.0F) return "opacity is outside 0..1";
  for (std::size_t i = 0; i < harmonics.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(harmonics[i][c])) return harmonic_name(i, c, harmonics.size()) + " is not finite";
  return {};
}

void GaussianRows::add(Gaussian gaussian, const glm::dvec4& rotation, std::span<const glm::vec3> harmonics) {
  std::string fault = fault_of(gaussian, harmonics);
  if (fault.empty()) fault = fault_of_rotation(rotation);
  if (!fault.empty()) return drop(fault);
  gaussian.rotation = rotation / glm::length(rotation);
  to_.gaussians.push_back(gaussian);
  to_.harmonics.insert(to_.harmonics.end(), harmonics.begin(), harmonics.end());
  if (!dropped_.empty()) to_.numbers.push_back(static_cast<std::uint32_t>(rows_));
  ++rows_;
}

void GaussianRows::drop(const std::string& fault) {
  if (dropped_.empty()) {
    to_.numbers.resize(to_.gaussians.size());
    std::iota(to_.numbers.begin(), to_.numbers.end(), 0U);
  }
  const auto known = std::ranges::find(dropped_, fault, &DroppedGaussians::cause);
  if (known == dropped_.end())
    dropped_.push_back({fault, 1, rows_});
  else
    ++known->count;
  ++rows_;
}

void GaussianRows::end() {
  if (dropped_.empty()) return;
  std::size_t count = 0;
  std::vector<std::string> causes;
  for (const DroppedGaussians& some : dropped_) {
    count += some.count;
    if (causes.size() < kMostNamed) causes.push_back(fmt::format("{} times {}", some.count, some.cause));
  }
  if (dropped_.size() > kMostNamed) causes.push_back(fmt::format("{} other causes", dropped_.size() - kMostNamed));
  const DroppedGaussians& first = dropped_.front();
  if (count < rows_) {
    to_.remarks.push_back(
        fmt::format("{} of {} Gaussians cannot be drawn and were dropped; the first is Gaussian {} (from 0): its {}",
                    count, rows_, first.first, first.cause) +
        (dropped_.size() > 1 ? fmt::format("; causes: {}", fmt::join(causes, ", ")) : ""));
    to_.dropped.insert(to_.dropped.end(), dropped_.begin(), dropped_.end());
    return;
  }
  throw_input({.where = where_,
               .what = fmt::format("none of the {} Gaussians can be drawn", rows_),
               .expected = "finite numbers and a non-zero rotation",
               .got = fmt::format("Gaussian 0: its {}", first.cause),
               .fix = "the file is damaged, or its training failed: write or download it again"});
}

}  // namespace fastsplat::scene
