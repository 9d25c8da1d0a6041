// SPDX-License-Identifier: Apache-2.0
// Cameras anywhere in a scene of Gaussians: from the files that trainers write, a matrix, or an eye and where it looks
// (docs/guide/gaussians.md).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fastsplat::scene {

/// What a pinhole camera maps to pixels.
struct Intrinsics {
  glm::dvec2 focal{0.0};   ///< pixels
  glm::dvec2 centre{0.0};  ///< where the view axis meets the picture; the first pixel's centre is (0, 0)
  int width = 0, height = 0;
};

/// In the axes of PLY files. Without axes it looks at `look_at`, without that at the scene's middle, upright.
struct PlacedCamera {
  std::string name{};
  glm::dvec3 eye{0.0};
  std::optional<glm::dvec3> look_at{};
  std::optional<glm::dmat3> axes{};        ///< columns: the picture's right, its down, and forward; a rotation
  std::optional<Intrinsics> intrinsics{};  ///< absent: from field of view and size
};

/// Cameras of a file and what of them is not drawn.
struct CameraFile {
  std::vector<PlacedCamera> cameras;
  std::vector<std::string> remarks{};
};

/// Reads cameras.json (trainers that follow Kerbl et al.) or transforms.json (nerfstudio, instant-ngp, Blender), by its
/// content. A file without sizes gets `size`. UserError (Input) if it is neither or damaged.
CameraFile load_cameras(const std::filesystem::path& path, const std::optional<glm::ivec2>& size);

/// Index of the camera with this name, or with this file name with or without ending, else of this number, from 0.
/// Throws UserError (Usage) for unknown cameras and for a file name that several cameras have.
std::size_t find_camera(const CameraFile& file, const std::string& name);

/// The intrinsics that shows the same at another size: centred, and everything of `intrinsics` is in the picture.
Intrinsics resized(const Intrinsics& intrinsics, int width, int height);

/// From 12 or 16 numbers, row by row: camera to scene, x right, y down, z forward. nullopt unless it is a rotation and
/// a position.
std::optional<PlacedCamera> camera_from_matrix(const std::vector<double>& numbers);

}  // namespace fastsplat::scene
