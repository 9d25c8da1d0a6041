// SPDX-License-Identifier: Apache-2.0
// What a frame took, and which of its values did not fit the formats.
#pragma once

#include <cstdint>

namespace fastsplat::driver {

/// Report of the driver on values that did not fit the formats; all but the first four are 0 in a healthy frame.
struct DriverReport {
  std::uint64_t voxels = 0;         ///< non-empty voxels
  std::uint64_t splat_records = 0;  ///< splat records over all tiles and sheets
  std::uint64_t tiles = 0;
  std::uint64_t sheets = 0;             ///< non-empty sheets over all tiles
  std::uint64_t saturated_voxels = 0;   ///< voxels whose whole splat left U 4.cf
  std::uint64_t saturated_records = 0;  ///< records whose share left the input format U 0.cf
  std::uint64_t vanished_voxels = 0;    ///< voxels whose words are all 0
  double vanished_share = 0.0;          ///< their share of all colour and opacity; 0 with error diffusion
  std::uint64_t widened_voxels = 0;  ///< drawn with a wider footprint than their own (driver/splats/ellipse_shape.hpp)
  bool carried = false;              ///< rounding errors were diffused from voxel to voxel (rounding.carry)
};

}  // namespace fastsplat::driver
