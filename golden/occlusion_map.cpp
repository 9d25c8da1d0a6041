// SPDX-License-Identifier: Apache-2.0
#include "golden/occlusion_map.hpp"

#include <cassert>

namespace fastsplat::golden {

OcclusionMap::OcclusionMap(int width, int height, const scene::Culling& culling)
    : width_(width),
      average_(culling.test == scene::VisibilityTest::Average),
      freeze_(culling.freeze),
      theta_(culling.theta),
      levels_(static_cast<std::size_t>(width) * height),
      opaque_after_(levels_.size()),
      table_(width, height) {}

namespace {
/// Opacity in units of 1/256, rounded down.
std::uint8_t opacity_byte(double transmittance) {
  return static_cast<std::uint8_t>(std::clamp(256.0 * (1.0 - transmittance), 0.0, 255.0));
}
}  // namespace

void OcclusionMap::update(std::span<const FrontToBack> picture, std::span<const Run> changed) {
  ++updates_;
  const int rows = static_cast<int>(changed.size());
  int first_row = rows;
  for (int y = 0; y < rows; ++y) {
    bool differs = false;
    const std::size_t row = static_cast<std::size_t>(y) * width_;
    for (std::size_t i = row + changed[y].begin; i < row + changed[y].end; ++i) {
      const double transmittance = picture[i].transmittance;
      if (opaque_after_[i] == 0 && transmittance < freeze_) opaque_after_[i] = updates_;
      const std::uint8_t now = average_ ? opacity_byte(transmittance) : (opaque_after_[i] > 0 ? 1 : 0);
      differs |= now != levels_[i];
      levels_[i] = now;
    }
    if (differs) first_row = std::min(first_row, y);
  }
  if (first_row == rows) return;
  any_ = true;
  table_.rebuild(levels_, first_row);
}

bool OcclusionMap::hides(const Window& window) const {
  assert(!window.empty());
  if (!any_) return false;
  const std::uint64_t area = window.area();
  if (!average_) return table_.sum(window) == area;
  constexpr std::uint64_t kLargestArea = (std::uint64_t{1} << 32) / 255;  // beyond it the sum may wrap around
  return area <= kLargestArea && table_.sum(window) >= theta_ * 256.0 * static_cast<double>(area);
}

Window window_around(double x, double y, double reach_x, double reach_y, int width, int height) {
  // Clipped as real numbers: the centre may be far outside the range of int.
  const auto first = [](double at, double reach, int end) {
    return static_cast<int>(std::clamp(std::ceil(at - reach), 0.0, static_cast<double>(end)));
  };
  const auto end = [](double at, double reach, int last) {
    return static_cast<int>(std::clamp(std::floor(at + reach) + 1.0, 0.0, static_cast<double>(last)));
  };
  return {first(x, reach_x, width), first(y, reach_y, height), end(x, reach_x, width), end(y, reach_y, height)};
}

}  // namespace fastsplat::golden
