// SPDX-License-Identifier: Apache-2.0
// Cost of a device of each index kind: bits, operations per pixel, cycles per splat; and the predictions of
// splatting.md, sections 1 and 5.
#pragma once

#include <cstdint>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

/// Whether the kind looks weights up in the radial table.
bool has_radial_table(cmodel::IndexKind kind);

/// Operations to compute one pixel's weight, multiply it by a colour and add the product; along a scan line by second
/// differences.
struct Operations {
  int adds = 0, multiplies = 0, reads = 0;
  int root_steps = 0;        ///< steps of the integer square root, one subtraction each
  const char* formula = "";  ///< formula of cycles_per_splat()
};
Operations operations(const cmodel::Config& config, int radius);

/// Bits of one radius set, and of the radial table if the kind has one.
std::uint64_t storage_bits(const cmodel::Config& config, int radius);
/// The same by the formulas of splatting.md: T b, k^2 (2r+1)^2 b, k E w + T b, k E w.
double predicted_bits(const cmodel::Config& config, int radius);

/// rlut, blit2d, separable: one window per cycle. squared, squared_elliptic: P pixels of a scan line per cycle. linear:
/// one pixel per cycle.
std::uint64_t cycles_per_splat(const cmodel::Config& config, int radius);

/// Predictions for a = R = 2, in 1/255. The RMS of a turned constant field from splat positions on a 1/K grid is
/// 0.27/(s K). The largest error from the table's steps is 4/N over the squared distance and 1.213/N over the distance;
/// 0 without a table.
double predicted_snap_rms(const cmodel::Config& config, double voxel);
double predicted_index_max(const cmodel::Config& config);

}  // namespace fastsplat::analysis
