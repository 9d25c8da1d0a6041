// SPDX-License-Identifier: Apache-2.0
// .splat, 32 bytes a Gaussian, little-endian: position and scale (linear) 3 floats each, R G B opacity and w x y z a
// byte each.
#pragma once

#include <string>

#include "scene/gaussians/gaussian_cloud.hpp"
#include "scene/gaussians/stored_range.hpp"

namespace fastsplat::scene {

inline constexpr std::size_t kSplatBytes = 32;
inline constexpr StoredRange kSplatColour{0.0, 1.0, 0.5 / 255.0};

/// Fills `to`, whose source names the file.
void read_splat(const std::string& bytes, GaussianCloud& to);
/// No harmonics above the constant; colour, opacity and rotation rounded to bytes.
std::string splat_bytes(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
