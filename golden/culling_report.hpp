// SPDX-License-Identifier: Apache-2.0
// Statistics of occlusion culling (early splat elimination) for one frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastsplat::golden {

/// voxels = outside + culled_in_blocks + culled_singly + splatted.
struct CullingReport {
  std::uint64_t voxels = 0;            ///< splats of the scene
  std::uint64_t outside = 0;           ///< outside the picture
  std::uint64_t culled_in_blocks = 0;  ///< never projected
  std::uint64_t culled_singly = 0;
  std::uint64_t splatted = 0;
  std::uint64_t splat_tests = 0, block_tests = 0;  ///< visibility tests made
  std::uint64_t blocks = 0, blocks_culled = 0;     ///< nodes of the octree; hidden nodes
  double map_seconds = 0.0;                        ///< updating the occlusion map and its table
  double test_seconds = 0.0;                       ///< building and opening blocks, projecting splats, testing
  /// Per pixel, row by row: number of sheets after which it became opaque; 0: never.
  std::vector<std::uint32_t> opaque_after;

  double share_splatted() const {
    return voxels == 0 ? 0.0 : static_cast<double>(splatted) / static_cast<double>(voxels);
  }
};

}  // namespace fastsplat::golden
