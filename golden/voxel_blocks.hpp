// SPDX-License-Identifier: Apache-2.0
// Voxel blocks for occlusion culling: an octree over the splats of a scene, with leaves of b x b x b voxels.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "golden/sheet_sweep.hpp"
#include "golden/summed_area_table.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

struct VoxelBlock {
  glm::vec3 low{0.0f}, high{0.0f};  ///< box of the splats' centres, mm
  std::uint16_t axis_sheet = 0;     ///< nearest axis-aligned sheet of its splats
  bool leaf = true;
  std::uint32_t first = 0, count = 0;  ///< leaf: splats, see VoxelBlocks::splats; else child blocks
  std::uint32_t splats = 0;            ///< in the whole subtree
};

class VoxelBlocks {
 public:
  /// `edge` is in voxels. Only blocks with splats are kept, so the tree may be empty.
  VoxelBlocks(const volume::Volume& volume, const std::vector<scene::Splat>& splats, int edge);

  /// The last block is the root. Children precede their parents and are contiguous.
  std::span<const VoxelBlock> blocks() const { return blocks_; }
  /// Indices of a leaf's splats, ascending.
  std::span<const std::uint32_t> splats(const VoxelBlock& leaf) const {
    return std::span(order_).subspan(leaf.first, leaf.count);
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<VoxelBlock> blocks_;
};

/// Bounds of a block's visible part. `window` holds every pixel that a circular footprint of its splats can reach.
/// `first_sheet` is the nearest sheet that one of them can reach, or an earlier one.
struct BlockView {
  Window window;
  int first_sheet = 0;
};
BlockView view_of(const scene::Scene& scene, const SheetAssignment& assignment, const VoxelBlock& block, int margin);

}  // namespace fastsplat::golden
