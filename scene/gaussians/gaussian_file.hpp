// SPDX-License-Identifier: Apache-2.0
// Files of 3-D Gaussians: .ply as trainers write it, and .splat, 32 bytes each (docs/techniques/gaussians.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

inline constexpr std::uint64_t kMostGaussianBytes = std::uint64_t{16} << 30;  ///< largest file

/// A built-in scene "name[:count]", or a file: PLY by its first line, others by their ending. Rows that cannot be drawn
/// are dropped with a remark. Every failure is a UserError (Input) with the fix.
GaussianCloud load_gaussians(const std::string& name_or_path);
/// The files that load_gaussians would read; empty for a built-in scene.
std::vector<std::filesystem::path> files_of_gaussians(const std::string& name_or_path);

/// PLY: ascii or binary of either byte order, properties in any order and of any type. Other properties are ignored
/// with a remark; other elements of fixed length are skipped. Required: x y z, scale_0..2 (logarithms; without the
/// third a disc), rot_0..3 (w x y z, any length), opacity (logit), and f_dc_0..2 or red green blue. Optional:
/// f_rest_0.. (9, 24 or 45, channel by channel, for degrees 1 to 3) and filter_3D. May be compressed by SuperSplat
/// (ply_packed.hpp). Comments that change the picture are followed (ply_hints.hpp).
GaussianCloud read_gaussian_ply(const std::filesystem::path& path);
/// 32 bytes each, little-endian: position and scale (linear) 3 floats each, R G B opacity and w x y z a byte each.
GaussianCloud read_splat_file(const std::filesystem::path& path);

enum class PlyText { Binary, Ascii };
/// The ending selects the format. .ply: floats, little-endian or as text, with the normals that viewers expect; scales
/// are clamped to at least 1e-10 and opacities to 1e-6..1-1e-6, so that floats hold their logarithms. .splat: no
/// harmonics above the constant; colour, opacity and rotation rounded to bytes. Atomic.
void save_gaussians(const GaussianCloud& cloud, const std::filesystem::path& path, PlyText text = PlyText::Binary);

/// Throws UserError (Input) if a number is not finite, a scale negative, or an opacity not in 0..1.
/// `where` names the Gaussian.
void check_gaussian(const Gaussian& gaussian, std::span<const glm::vec3> harmonics, const std::string& where);

}  // namespace fastsplat::scene
