// SPDX-License-Identifier: Apache-2.0
// Axis-aligned sheets (Westover 1990): the volume's own slices most perpendicular to the view are the sheets, and a
// splat goes whole into its slice's sheet. When the view turns past 45 degrees the slices change axis and the picture
// pops.
#include "golden/occlusion_culling.hpp"
#include "golden/render.hpp"
#include "golden/sheet_sweep.hpp"

namespace fastsplat::golden {

Image axis_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  return composite_visible(scene, splats, options,
                           WholeSplats(scene::sheet_plan(scene, scene::Method::AxisAligned).slabs.count));
}

}  // namespace fastsplat::golden
