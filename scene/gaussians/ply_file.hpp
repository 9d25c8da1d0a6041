// SPDX-License-Identifier: Apache-2.0
// PLY files of 3-D Gaussians.
#pragma once

#include <string>
#include <string_view>

#include "scene/gaussians/gaussian_cloud.hpp"
#include "scene/gaussians/stored_range.hpp"

namespace fastsplat::scene {

bool is_ply(std::string_view head);

/// Fills `to`, whose source names the file. ascii or binary of either byte order, properties in any order and of any
/// type. Other properties are ignored with a remark; other elements of fixed length are skipped. Required: x y z,
/// scale_0..2 (logarithms; without the third a disc), rot_0..3 (w x y z, any length), opacity (logit), and f_dc_0..2 or
/// red green blue. Optional: f_rest_0.. (9, 24 or 45, channel by channel, for degrees 1 to 3) and filter_3D. May be
/// compressed by SuperSplat (ply_packed.hpp). Comments that change the picture are followed (ply_hints.hpp).
void read_ply(const std::string& text, GaussianCloud& to);

enum class PlyText { Binary, Ascii };
inline constexpr StoredRange kPlyLogScale{-23.025850929940457, 88.7228, 1e-6};  ///< from 1e-10 to the largest float
/// Floats, little-endian or as text, with the normals that viewers expect. Opacities are clamped to 1e-6..1-1e-6, so
/// that floats hold their logits.
std::string ply_bytes(const GaussianCloud& cloud, PlyText text = PlyText::Binary);

/// Header lines of what read_ply follows: the vertical axis, anti-aliasing, linear colours.
std::string ply_comments(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
