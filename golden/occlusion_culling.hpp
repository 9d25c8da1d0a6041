// SPDX-License-Identifier: Apache-2.0
// Early splat elimination (Mueller, Shareef, Huang, Crawfis 1999): before a sheet is splatted, the splats that begin in
// it are tested against the occlusion map of the sheets so far. Front to back a pixel's transmittance only falls, and
// an opaque pixel is terminated. So with VisibilityTest::Count no culled splat could have changed a bit.
#pragma once

#include <cstdint>
#include <vector>

#include "golden/culling_report.hpp"
#include "golden/frame_sweep.hpp"
#include "golden/occlusion_map.hpp"
#include "golden/splat/projection.hpp"
#include "golden/voxel_blocks.hpp"

namespace fastsplat::golden {

/// CullingMode::Blocks: a block waits for the nearest sheet that it can reach and is tested there. If it is hidden, its
/// voxels are never read. If not, its children wait for their own sheets, and a leaf's splats for theirs.
/// CullingMode::Splats: every splat waits from the beginning. In both modes each remaining splat is tested by its own
/// footprint's window.
class OcclusionCulling final : public Occlusion {
 public:
  /// culling.mode must not be Off; culling.freeze is the transmittance below which a pixel counts as opaque. Nothing is
  /// copied: all arguments must outlive this object.
  OcclusionCulling(const scene::Scene& scene, const std::vector<scene::Splat>& splats, int threads,
                   const SheetAssignment& assignment, const scene::Culling& culling);

  std::span<const ProjectedSplat> visible(int sheet, int margin) override;
  void composited(std::span<const FrontToBack> picture, std::span<const Run> changed) override;

  CullingReport report() const;

 private:
  void open_blocks(int sheet, int margin);
  void open(std::span<const std::uint32_t> splats);
  void test_splats(int sheet, int margin);

  const scene::Scene& scene_;
  const std::vector<scene::Splat>& splats_;
  int threads_;
  const SheetAssignment& assignment_;
  int width_, height_;
  Projector project_;
  CullingReport report_;
  OcclusionMap map_;
  VoxelBlocks blocks_;
  std::vector<std::vector<std::uint32_t>> waiting_blocks_, waiting_splats_;  ///< by sheet
  std::vector<ProjectedSplat> projected_;                                    ///< of the current sheet
  std::vector<std::uint8_t> hidden_;                                         ///< of the splats tested
};

/// Composites the sheets front to back with the scene's early termination and culling, and with `stages`, whose
/// occlusion and freeze_below are taken from the scene. Without culling and stages it is composite_sheets.
Image composite_visible(const scene::Scene& scene, const std::vector<scene::Splat>& splats,
                        const RenderOptions& options, const SheetAssignment& assignment, FrameStages stages = {});

}  // namespace fastsplat::golden
