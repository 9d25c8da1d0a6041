// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/bricks.hpp"

#include <algorithm>

namespace fastsplat::volume {

std::vector<Brick> bricks_of(const Volume& volume) {
  constexpr int kSide = Brick::kSide;
  std::vector<Brick> bricks;
  const glm::ivec3 count = (volume.dims + (kSide - 1)) / kSide;
  bricks.reserve(static_cast<std::size_t>(count.x) * count.y * count.z);
  for (int z = 0; z < count.z; ++z) {
    for (int y = 0; y < count.y; ++y) {
      for (int x = 0; x < count.x; ++x) {
        const glm::ivec3 low = glm::ivec3(x, y, z) * kSide;
        Brick brick{.low = low, .high = glm::min(low + kSide, volume.dims) - 1};
        brick.least = brick.greatest = volume.at(low.x, low.y, low.z);
        for (int k = brick.low.z; k <= brick.high.z; ++k) {
          for (int j = brick.low.y; j <= brick.high.y; ++j) {
            const float* row = &volume.voxels[volume.index(0, j, k)];
            for (int i = brick.low.x; i <= brick.high.x; ++i) {
              brick.least = std::min(brick.least, row[i]);
              brick.greatest = std::max(brick.greatest, row[i]);
            }
          }
        }
        bricks.push_back(brick);
      }
    }
  }
  return bricks;
}

}  // namespace fastsplat::volume
