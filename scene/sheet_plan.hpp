// The sheets of a frame: the parts of a splat, the number of sheets and their places. Every engine uses this plan.
#pragma once

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// Where a splat goes. In order: shares into the slabs that its kernel reaches (image-aligned, X-ray of several
/// sheets); whole into the sheet of its grid slice (axis-aligned). Whole into the only sheet (X-ray); a method without
/// sheets.
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
  SlabGrid slabs;  ///< of Sliced and OneSheet; of GridSheet and None only the count
};

/// Sheet 0 is nearest to the eye.
///   image-aligned: slab_grid(); if anti-aliased kernels grow, with whole slabs added at both ends, so that the nearest
///     and the farthest voxels have slabs as thin as all others. Existing slabs keep their places.
///     UserError (Usage) when these are more than kMostSlabsMore.
///   axis-aligned: axis_sheet_count() sheets.
///   X-ray: the depth range of slab_grid() in the required number of slabs; the sum must not depend on it.
SheetPlan sheet_plan(const Scene& scene, Method method);
inline SheetPlan sheet_plan(const Scene& scene) { return sheet_plan(scene, scene.description.method); }

/// Limit of slabs added for grown kernels: each one that a splat reaches is kept in memory.
inline constexpr double kMostSlabsMore = 4096;

/// The slabs that kernels of the scene's own size reach, of the description's width. A boundary lies on the volume's
/// centre in every view. The count depends only on the bounding radius, the kernel and the width.
SlabGrid slab_grid(const Scene& scene);

}  // namespace fastsplat::scene
