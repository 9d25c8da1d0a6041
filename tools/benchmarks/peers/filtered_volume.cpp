// SPDX-License-Identifier: Apache-2.0
#include "tools/benchmarks/peers/filtered_volume.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace fastsplat::bench {
namespace {

/// The points along one axis: `finer` per voxel, from `reach` voxels before the first to as many after the last.
/// Weights depend only on a point's place between two voxels, one of `finer`.
class Axis {
 public:
  Axis(int voxels, double spacing, double unit, const scene::Kernel& kernel, int finer)
      : voxels_(voxels), finer_(finer), reach_(static_cast<int>(std::ceil(kernel.radius() * unit / spacing))) {
    for (int place = 0; place < finer_; ++place) {
      for (int tap = 0; tap < taps(); ++tap) {
        const double distance = (static_cast<double>(place) / finer_ + reach_ - 1 - tap) * spacing / unit;
        weights_.push_back(kernel.profile(distance) * spacing / unit);
      }
    }
  }

  int points() const { return finer_ * (voxels_ - 1 + 2 * reach_) + 1; }

  /// Calls add_line(voxel, weight) for each voxel within the kernel around the point.
  template <class AddLine>
  void gather(int point, const AddLine& add_line) const {
    const int before = point / finer_ - reach_;  // the voxel at or before the point
    const double* weight = &weights_[static_cast<std::size_t>(point % finer_) * taps()];
    for (int tap = 0; tap < taps(); ++tap) {
      const int voxel = before - reach_ + 1 + tap;
      if (voxel >= 0 && voxel < voxels_ && weight[tap] > 0.0) add_line(voxel, static_cast<float>(weight[tap]));
    }
  }

 private:
  int taps() const { return 2 * reach_; }

  int voxels_, finer_, reach_;
  std::vector<double> weights_;
};

/// Filters `in`, of shape count x voxels x run, along the middle dimension.
std::vector<float> along(const Axis& axis, const std::vector<float>& in, int voxels, std::size_t run) {
  const std::size_t count = in.size() / (static_cast<std::size_t>(voxels) * run);
  std::vector<float> out(count * axis.points() * run);
  float* to = out.data();
  for (std::size_t block = 0; block < count; ++block) {
    for (int point = 0; point < axis.points(); ++point, to += run) {
      axis.gather(point, [&](int voxel, float weight) {
        const float* from = &in[(block * voxels + voxel) * run];
        for (std::size_t i = 0; i < run; ++i) to[i] += weight * from[i];
      });
    }
  }
  return out;
}

}  // namespace

volume::Volume filtered(const volume::Volume& volume, const scene::Kernel& kernel, int finer) {
  volume::Volume out;
  out.name = volume.name;
  out.source = volume.source;
  out.stored = volume::VoxelType::F32;
  out.spacing = volume.spacing / static_cast<double>(finer);
  out.voxels.resize(volume.voxels.size());
  std::ranges::transform(volume.voxels, out.voxels.begin(), [&](float value) { return value - volume.min; });
  std::size_t run = 1;  // floats per step along the current axis
  for (int a = 0; a < 3; ++a) {
    const Axis axis(volume.dims[a], volume.spacing[a], volume.kernel_unit(), kernel, finer);
    out.voxels = along(axis, out.voxels, volume.dims[a], run);
    out.dims[a] = axis.points();
    run *= static_cast<std::size_t>(axis.points());
  }
  for (float& value : out.voxels) value += volume.min;
  const auto [least, greatest] = std::ranges::minmax(out.voxels);
  out.min = least, out.max = greatest;
  return out;
}

}  // namespace fastsplat::bench
