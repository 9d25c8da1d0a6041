// Image-aligned sheets (Mueller, Crawfis 1998): slabs parallel to the image plane; all kernel material between two
// planes is added into the sheet before the sheet is composited. A voxel's kernel is cut into slices by the slabs it
// spans.
#include "golden/render.hpp"
#include "golden/sheet_sweep.hpp"

namespace fastsplat::golden {

Image image_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  return composite_sheets(scene, splats, options, image_slabs(scene));
}

}  // namespace fastsplat::golden
