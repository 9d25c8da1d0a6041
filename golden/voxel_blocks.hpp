// Voxel sets for occlusion culling: an octree whose leaves are bricks of b x b x b voxels, over the splats of a scene.
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
  std::uint16_t axis_sheet = 0;     ///< the nearest axis-aligned sheet of its splats
  bool leaf = true;
  std::uint32_t first = 0, count = 0;  ///< leaf: splats, by VoxelBlocks::splats; else blocks
  std::uint32_t splats = 0;            ///< in all
};

class VoxelBlocks {
 public:
  /// `edge` voxels. Blocks without splats are left out; no splats, no blocks.
  VoxelBlocks(const volume::Volume& volume, const std::vector<scene::Splat>& splats, int edge);

  /// The last one is the root: children lie before their parents, side by side.
  std::span<const VoxelBlock> blocks() const { return blocks_; }
  /// Indices of a leaf's splats, rising.
  std::span<const std::uint32_t> splats(const VoxelBlock& leaf) const {
    return std::span(order_).subspan(leaf.first, leaf.count);
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<VoxelBlock> blocks_;
};

/// Bounds of a block's visible part: at least every pixel that a circular footprint of its splats can reach, and the
/// nearest sheet that one of them can reach, or one before it.
struct BlockView {
  Window window;
  int first_sheet = 0;
};
BlockView view_of(const scene::Scene& scene, const SheetAssignment& assignment, const VoxelBlock& block, int margin);

}  // namespace fastsplat::golden
