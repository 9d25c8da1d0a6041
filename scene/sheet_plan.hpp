// The sheets of a frame: what becomes of a splat, how many sheets there are and where they lie. Every engine asks here.
#pragma once

#include "scene/scene.hpp"

namespace fastsplat::scene {

/// Where a splat goes: in shares into the slabs that its kernel reaches (image-aligned, X-ray of several sheets), whole
/// into the sheet of its grid slice (axis-aligned), whole into the only sheet (X-ray), or no method of sheets.
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
///   image-aligned: slab_grid(); where anti-aliased kernels grow, with whole slabs added at both ends, so that the
///     nearest and the farthest voxels find slabs as thin as all others. What was there keeps its place.
///     UserError (Usage) when these are more than kMostSlabsMore.
///   axis-aligned: axis_sheet_count() sheets.
///   X-ray: the depth range of slab_grid() in as many slabs as asked for; the sum must not depend on it.
SheetPlan sheet_plan(const Scene& scene, Method method);
inline SheetPlan sheet_plan(const Scene& scene) { return sheet_plan(scene, scene.description.method); }

/// The most slabs that grown kernels may add: each one that a splat reaches is kept in memory.
inline constexpr double kMostSlabsMore = 4096;

/// The slabs that kernels of the scene's own size reach, of the description's width. A boundary lies on the volume's
/// centre whatever the view, and the count depends only on the bounding radius, the kernel and the width.
SlabGrid slab_grid(const Scene& scene);

}  // namespace fastsplat::scene
