// What a device of each kind of index would hold and do: bits, operations a pixel, cycles a splat; and what the report
// on the family predicts (splatting.md, sections 1 and 5).
#pragma once

#include <cstdint>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

/// Whether the kind looks weights up in the radial table.
bool has_radial_table(cmodel::IndexKind kind);

/// On the way to one pixel's weight, and to multiply it by a colour and add that; along a scan line's second
/// difference.
struct Operations {
  int adds = 0, multiplies = 0, reads = 0;
  int root_steps = 0;        ///< of the integer square root, a subtraction each
  const char* formula = "";  ///< of cycles_per_splat(), in words
};
Operations operations(const cmodel::Config& config, int radius);

/// Bits held of one radius set, and of the radial table where there is one.
std::uint64_t storage_bits(const cmodel::Config& config, int radius);
/// The same by the report's formulas: T b, k^2 (2r+1)^2 b, k E w + T b, k E w.
double predicted_bits(const cmodel::Config& config, int radius);

/// rlut, blit2d, separable: a window a cycle. squared, squared_elliptic: P pixels of a scan line a cycle. linear: a
/// pixel.
std::uint64_t cycles_per_splat(const cmodel::Config& config, int radius);

/// Predictions for a = R = 2, in 1/255. The rms of a turned constant field by its splats' places on a 1/K grid is
/// 0.27/(s K). The largest error by the table's steps is 4/N over the squared distance and 1.213/N over the distance; 0
/// without a table.
double predicted_snap_rms(const cmodel::Config& config, double voxel);
double predicted_index_max(const cmodel::Config& config);

}  // namespace fastsplat::analysis
