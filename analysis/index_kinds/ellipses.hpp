// SPDX-License-Identifier: Apache-2.0
// Elliptical footprints with index.kind squared_elliptic: the error of its weights against golden's, and the error of
// circles in their place.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/index_kinds/weight_field.hpp"

namespace fastsplat::analysis {

/// Weights of many splats, each at its own position on the 1/64 pixel grid, against golden's. Over the pixels where
/// either is not 0, in 1/255 of the splat's peak; without the rounding of centres.
struct EllipseErrors {
  std::uint64_t splats = 0, pixels = 0;
  double aspect = 1.0;         ///< greatest ratio of long to short half axis
  double longest = 0.0;        ///< half axis, pixels
  FieldError ellipse;          ///< of the words of driver::ellipse_table()
  FieldError circle;           ///< of a circle of the nearest radius set, with the splat's energy
  double entries_off = 0.0;    ///< largest error of q by the words, radial table entries
  double entries_bound = 0.0;  ///< its bound (docs/numerics.md, N-4.3-7)
  std::int64_t least_q = 0;    ///< over all pixels of all windows
};

/// The voxels of shells:32 at 128 x 128, seen at `fov` degrees.
EllipseErrors perspective_ellipses(double fov);
/// 500 ellipses spread evenly over long half axes of 2 to 32 pixels, ratios to `aspect` and all angles; without
/// `circle`.
EllipseErrors spread_ellipses(double aspect);

}  // namespace fastsplat::analysis
