// SPDX-License-Identifier: Apache-2.0
// A set of index.kind squared_elliptic for an ellipse at any angle (docs/numerics.md, N-4.3-6 and N-4.3-7). The
// driver's frames have sets of circles only: this is for analysis.
#pragma once

#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::driver {

/// The edge of a footprint: d^T S^-1 d = 1 with S = (xx xy; xy yy), square pixels. Its half sides are sqrt(xx) and
/// sqrt(yy).
struct EllipseRim {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

/// For ellipses with a shorter half axis of at least 1/K pixel and an axis ratio of at most 1024. Then 4 A C >= B^2
/// whatever the roundings, and no word saturates. A circle gets the words of set_table().
cmodel::LoadTable ellipse_table(const cmodel::Config& config, std::uint32_t set, const EllipseRim& rim);

}  // namespace fastsplat::driver
