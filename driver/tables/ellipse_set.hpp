// A set of index.kind squared_elliptic for an ellipse that lies as it likes (docs/numerics.md, section 4.3). Frames
// have circles only: this is for analysis, and for a driver that will draw golden's elliptical footprints.
#pragma once

#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::driver {

/// The rim of a footprint: d^T S^-1 d = 1 with S = (xx xy; xy yy), square pixels. Its half sides are sqrt(xx) and
/// sqrt(yy).
struct EllipseRim {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// For ellipses whose shorter half axis is at least 1/K pixel and whose axes are as 1 to 1024 at most: then 4 A C >=
/// B^2 whatever the roundings, and no word is cut. What a circle gets here is what set_table() gives it.
cmodel::LoadTable ellipse_table(const cmodel::Config& config, std::uint32_t set, const EllipseRim& rim);

}  // namespace fastsplat::driver
