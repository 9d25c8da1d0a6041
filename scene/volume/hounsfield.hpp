// SPDX-License-Identifier: Apache-2.0
// Detects whether a volume's values are those of a CT; files do not declare it.
#pragma once

#include <optional>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

/// Hounsfield units (HU) up to which a CT shows air, with the noise of a scanner.
inline constexpr double kAirHu = -900.0;

/// The value of water (0 HU) in a CT; nullopt for other volumes. The least value may be padding and does not count.
/// At most a hundredth of the voxels may lie below -1100 HU, where phases of an MRI have many.
/// - 1024 (an offset that scanners add to store unsigned values) if the greatest value is 1500 or more and half of the
///   voxels above air lie between -200 and 300 HU. That is fat and soft tissue; an MRI of 12 bits spreads wider.
/// - Else 0 if the least value is -500 or lower and a tenth of the voxels above air lie in that range.
std::optional<double> find_water(const Volume& volume);

}  // namespace fastsplat::volume
