// Elliptical footprints by the unit squared_elliptic: how far its weights lie from golden's, and what circles would
// have made of them.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/index_kinds/weight_field.hpp"

namespace fastsplat::analysis {

/// Weights of many splats, each at its own place on the 1/64 pixel grid, against golden's; over the pixels where
/// either is not 0, in 1/255 of the splat's peak. The centre's own rounding is not in it.
struct EllipseErrors {
  std::uint64_t splats = 0, pixels = 0;
  double aspect = 1.0;         ///< greatest ratio of long to short half axis
  double longest = 0.0;        ///< half axis, pixels
  FieldError ellipse;          ///< of the words of driver::ellipse_table()
  FieldError circle;           ///< of a circle of the nearest radius set, with the splat's energy
  double entries_off = 0.0;    ///< furthest that the words take q from the ellipse's own, radial table entries
  double entries_bound = 0.0;  ///< docs/numerics.md, section 4.3
  std::int64_t least_q = 0;    ///< of all pixels of all windows
};

/// The voxels of shells:32 at 128 x 128, seen at `fov` degrees.
EllipseErrors perspective_ellipses(double fov);
/// 500 that are spread evenly over long half axes of 2 to 32 pixels, ratios to `aspect` and all angles; a circle's
/// share is left out.
EllipseErrors spread_ellipses(double aspect);

}  // namespace fastsplat::analysis
