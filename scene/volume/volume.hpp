// SPDX-License-Identifier: Apache-2.0
// A scalar volume on a regular grid, from any file or generator.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fastsplat::volume {

enum class VoxelType { U8, I8, U16, I16, F32 };

/// Voxels as float (exact for 8 and 16 bit), x fastest. World space is millimetres with the volume's centre at the
/// origin. Its axes are the grid's: voxel (i,j,k) sits at (index - (dims-1)/2) * spacing. An oblique volume, whose file
/// declares axes that differ from those of the body, has the body's axes as world axes.
struct Volume {
  std::string name;    ///< as the user gave it: a path or "shells:128"
  std::string source;  ///< provenance for image metadata: resolved path or generator, one line
  glm::ivec3 dims{0};
  glm::dvec3 spacing{1.0};  ///< mm per voxel, each > 0
  VoxelType stored = VoxelType::F32;
  float min = 0.0f;  ///< over all voxels (finite; NaN and Inf in a file are refused)
  float max = 0.0f;
  std::vector<float> voxels;
  bool built_in = false;          ///< made by a generator: its values have no unit
  std::optional<double> water{};  ///< the value of 0 HU, if the values are those of a CT (hounsfield.hpp)
  bool oblique = false;           ///< `axes` is not the unit matrix
  glm::dmat3 axes{1.0};    ///< columns: unit vectors in the world along the grid's x, y, z; mostly at right angles
  glm::dmat3 across{1.0};  ///< inverse of `axes`
  bool placed = false;     ///< the file declares the volume's place in a body: +x right, +y anterior, +z superior
  glm::dvec3 centre{0.0};  ///< the volume's centre there, mm; files only, the world's origin is the centre
  std::vector<std::string> remarks{};  ///< assumptions and oddities of the input, a sentence each

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * dims.y + static_cast<std::size_t>(j)) * dims.x + static_cast<std::size_t>(i);
  }
  float at(int i, int j, int k) const { return voxels[index(i, j, k)]; }
  glm::dvec3 position(int i, int j, int k) const {
    return to_world((glm::dvec3(i, j, k) - 0.5 * glm::dvec3(dims - 1)) * spacing);
  }
  /// Converts mm along the grid's axes, from the centre, to the world and back.
  glm::dvec3 to_world(const glm::dvec3& along) const { return oblique ? axes * along : along; }
  glm::dvec3 to_grid(const glm::dvec3& world) const { return oblique ? across * world : world; }
  void turn(const glm::dmat3& to) { oblique = true, axes = to, across = glm::inverse(to); }
  /// Edge of the cubic cell to which the kernel is scaled: the largest spacing (docs/decisions.md, "Anisotropic
  /// grids").
  double kernel_unit() const { return glm::max(spacing.x, glm::max(spacing.y, spacing.z)); }
  /// Half the diagonal of the box of voxel centres, mm. Independent of the view.
  double bounding_radius() const;
};

/// Central differences at a voxel (one-sided at the border), in value per mm of the world.
glm::vec3 gradient(const Volume& volume, int i, int j, int k);

}  // namespace fastsplat::volume
