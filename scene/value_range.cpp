// SPDX-License-Identifier: Apache-2.0
#include "scene/value_range.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "scene/volume/hounsfield.hpp"

namespace fastsplat::scene {
namespace {

constexpr double kLowRank = 0.005, kHighRank = 0.998;

std::size_t rank_of(double share, std::size_t count) {
  return static_cast<std::size_t>(share * static_cast<double>(count - 1));
}

float nth(std::vector<float>& values, std::size_t rank) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The voxels of the six faces, each once.
std::vector<float> faces_of(const volume::Volume& volume) {
  const glm::ivec3 last = volume.dims - 1;
  std::vector<float> values;
  for (int k = 0; k <= last.z; ++k) {
    for (int j = 0; j <= last.y; ++j) {
      const bool whole_row = k == 0 || k == last.z || j == 0 || j == last.y;
      for (int i = 0; i <= last.x; i += whole_row ? 1 : std::max(1, last.x)) values.push_back(volume.at(i, j, k));
    }
  }
  return values;
}

/// Median, and the deviation of a normal distribution with the same median of absolute differences.
std::pair<double, double> level_of(std::vector<float> values) {
  constexpr double kDeviationPerMedian = 1.4826;
  const float median = nth(values, values.size() / 2);
  for (float& value : values) value = std::abs(value - median);
  return {median, kDeviationPerMedian * nth(values, values.size() / 2)};
}

/// The greatest value of air in a CT.
std::optional<double> air_value(const volume::Volume& volume) {
  if (!volume.water) return std::nullopt;
  return std::max<double>(volume.min, *volume.water + volume::kAirHu);
}

}  // namespace

double background_top(const volume::Volume& volume) {
  constexpr double kDeviations = 6.0, kOneLevel = 0.03, kDarker = 0.05;
  if (const auto air = air_value(volume)) return *air;
  auto faces = faces_of(volume);
  auto [median, deviation] = level_of(faces);
  // The least value far below that level is padding, as in the corners of a round field of view.
  const bool padded = median - kDeviations * deviation > volume.min && std::erase(faces, volume.min) > 0;
  if (padded) std::tie(median, deviation) = level_of(faces);
  if (!(deviation <= kOneLevel * (static_cast<double>(volume.max) - volume.min))) return volume.min;
  const double bottom = median - kDeviations * deviation;
  const auto darker = std::count_if(volume.voxels.begin(), volume.voxels.end(),
                                    [&](float v) { return v < bottom && !(padded && v == volume.min); });
  const bool lowest = static_cast<double>(darker) <= kDarker * static_cast<double>(volume.voxels.size());
  return lowest ? median + kDeviations * deviation : volume.min;
}

RankedValues::RankedValues(const volume::Volume& volume, double above) {
  if (volume.stored == volume::VoxelType::F32) {
    std::copy_if(volume.voxels.begin(), volume.voxels.end(), std::back_inserter(values_),
                 [above](float v) { return v > above; });
    count_ = values_.size();
    return;
  }
  first_ = volume.min;
  counts_.assign(static_cast<std::size_t>(volume.max - volume.min) + 1, 0);
  for (const float v : volume.voxels) {
    if (!(v > above)) continue;
    ++counts_[static_cast<std::size_t>(v - volume.min)];
    ++count_;
  }
}

double RankedValues::at(double share) {
  std::size_t left = rank_of(share, count_);
  if (!values_.empty()) return nth(values_, left);
  std::size_t value = 0;
  while (left >= counts_[value]) left -= counts_[value++];
  return first_ + static_cast<double>(value);
}

ValueSpan shown_span(const volume::Volume& volume) {
  RankedValues ranked(volume, background_top(volume));
  if (ranked.count() == 0) return {volume.min, volume.max};
  const double low = air_value(volume).value_or(ranked.at(kLowRank));
  return {low, ranked.at(kHighRank)};
}

double spread(const volume::Volume& volume) {
  return static_cast<double>(volume.max) - air_value(volume).value_or(volume.min);
}

}  // namespace fastsplat::scene
