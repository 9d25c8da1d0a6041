// SPDX-License-Identifier: Apache-2.0
// SPZ, Niantic's packed Gaussians: versions 2 and 3 in gzip, version 4 as Zstandard frames.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// Recognises a file by its first bytes.
bool is_spz(std::string_view head);

/// Fills `to`, whose source names the file. Degree 4 is read as degree 3, with a remark. UserError (Input) for other
/// versions, for data that does not have the declared size, and for axes that are not those of SPZ or their opposites.
void read_spz(const std::string& bytes, GaussianCloud& to);

/// Version 3. Positions in steps of 2^-12, or coarser if the scene reaches beyond +-2048.
std::string spz_bytes(const GaussianCloud& cloud);
/// How far this moves each Gaussian.
std::vector<double> spz_rounding(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
