// SPDX-License-Identifier: Apache-2.0
// SOG, PlayCanvas' Gaussians packed in WebP pictures: a zip archive, or a meta.json with the pictures beside it.
#pragma once

#include <string>
#include <string_view>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// An archive that names pictures or a meta.json.
bool is_sog(std::string_view head);
/// The meta.json of an unpacked scene.
bool is_sog_meta(std::string_view head);

/// Fill `to`, whose source is the path of the file; the bytes are read from there. Versions 1 and 2. UserError (Input)
/// for pictures that are missing, too small or too large, and for invalid tables. Gaussians with an invalid code of
/// rotation or harmonics are dropped.
void read_sog(const std::string& bytes, GaussianCloud& to);
void read_sog_meta(const std::string& bytes, GaussianCloud& to);

}  // namespace fastsplat::scene
