// SPDX-License-Identifier: Apache-2.0
// The sheets of a frame: their number and places, and how splats are divided among them. Every engine uses this plan.
#pragma once

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// Where a splat goes. Sliced: in shares into the slabs that its kernel reaches (image-aligned, X-ray of several
/// sheets). GridSheet: whole into the sheet of its grid slice (axis-aligned). OneSheet: whole into the only sheet
/// (X-ray). None: the method has no sheets.
enum class SheetUse { Sliced, GridSheet, OneSheet, None };

/// Slabs parallel to the image: s covers depth [first + s*width, first + (s+1)*width) in kernel units, relative to the
/// volume's centre.
struct SlabGrid {
  double first = 0.0;  ///< depth of the nearest boundary
  double width = 1.0;
  int count = 0;
};

struct SheetPlan {
  SheetUse use = SheetUse::None;
  SlabGrid slabs;  ///< for GridSheet and None only the count is valid
};

/// Sheet 0 is nearest to the eye.
///   image-aligned: slab_grid(). If anti-aliased kernels grow, whole slabs are added at both ends, so that the nearest
///     and the farthest voxels have slabs as thin as all others. Existing slabs keep their places.
///     UserError (Usage) if more than kMostSlabsMore are added.
///   axis-aligned: axis_sheet_count() sheets.
///   X-ray: the depth range of slab_grid() in the required number of slabs; the sum must not depend on it.
SheetPlan sheet_plan(const Scene& scene, Method method);
inline SheetPlan sheet_plan(const Scene& scene) { return sheet_plan(scene, scene.description.method); }

/// Limit of slabs added for grown kernels: each one that a splat reaches is kept in memory.
inline constexpr double kMostSlabsMore = 4096;

/// Slabs of the description's width that kernels of the scene's own size reach. A boundary lies on the volume's centre
/// in every view. The count depends only on the bounding radius, the kernel and the width.
SlabGrid slab_grid(const Scene& scene);

}  // namespace fastsplat::scene
