// SPDX-License-Identifier: Apache-2.0
// The bytes of a .splat file.
#pragma once

#include <string>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

inline constexpr std::size_t kSplatBytes = 32;

std::string splat_bytes(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
