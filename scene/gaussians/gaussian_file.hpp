// SPDX-License-Identifier: Apache-2.0
// Files of 3-D Gaussians, of any format (docs/guide/gaussian-files.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"
#include "scene/gaussians/ply_file.hpp"

namespace fastsplat::scene {

inline constexpr std::uint64_t kMostGaussianBytes = std::uint64_t{16} << 30;  ///< largest file

/// A built-in scene "name[:count]", or a file, recognised by its content; .splat by its ending. Gaussians that cannot
/// be drawn are dropped with a remark. Every failure is a UserError (Input) with the fix.
GaussianCloud load_gaussians(const std::string& name_or_path);
/// The files that load_gaussians would read; empty for a built-in scene.
std::vector<std::filesystem::path> files_of_gaussians(const std::string& name_or_path);

/// Throws UserError (Input) that names the first cause if Gaussians were dropped.
void refuse_dropped(const GaussianCloud& cloud);

/// Endings of the formats that are written: .compressed.ply, .ply, .splat, .spz, .glb.
std::vector<std::string> written_gaussian_endings();
/// UserError (Usage) unless the ending is one of these.
void check_gaussian_ending(const std::filesystem::path& path);
/// What a file of this ending cannot hold of the cloud, a sentence each.
std::vector<std::string> lost_in_gaussian_file(const GaussianCloud& cloud, const std::filesystem::path& path);
/// The ending selects the format (ply_file.hpp, ply_packed.hpp, splat_file.hpp, spz_file.hpp, gltf_file.hpp). Atomic.
/// `text`: of .ply.
void save_gaussians(const GaussianCloud& cloud, const std::filesystem::path& path, PlyText text = PlyText::Binary);

/// Throws UserError (Input) if a number is not finite, a scale negative, or an opacity not in 0..1.
/// `where` names the Gaussian.
void check_gaussian(const Gaussian& gaussian, std::span<const glm::vec3> harmonics, const std::string& where);

}  // namespace fastsplat::scene
