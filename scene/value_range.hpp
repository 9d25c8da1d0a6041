// SPDX-License-Identifier: Apache-2.0
// Background and percentiles of a volume's values.
#pragma once

#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

struct ValueSpan {
  double low, high;
};

/// The greatest value of the background. In a CT, -900 HU: air, and the filling of the corners outside the round field.
/// In other volumes, six standard deviations above the median of the six faces. This requires faces of one level, a
/// deviation below 3 % of the range, and at most 5 % of the voxels below that level. Else the least value.
double background_top(const volume::Volume& volume);

/// Values by rank among the voxels above `above`: by counting for whole numbers, by selection for others.
class RankedValues {
 public:
  RankedValues(const volume::Volume& volume, double above);
  std::size_t count() const { return count_; }
  /// The value that `share` (0..1) of the voxels do not exceed. count() must be above 0.
  double at(double share);

 private:
  std::size_t count_ = 0;
  double first_ = 0.0;               // value of counts_[0]
  std::vector<std::size_t> counts_;  // of each whole number
  std::vector<float> values_;        // of volumes that store other numbers
};

/// From the 0.5 percentile (in a CT, from the background's top) to the 99.8 percentile of the voxels above the
/// background. The whole range if no voxel is above it.
ValueSpan shown_span(const volume::Volume& volume);

/// The spread of the values, the unit of relative settings: from the least value, in a CT from air, to the greatest.
double spread(const volume::Volume& volume);

}  // namespace fastsplat::scene
