// A scalar volume on a rectilinear grid, whatever file or generator it came from.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace fastsplat::volume {

enum class VoxelType { U8, I8, U16, I16, F32 };

/// Voxels as float (exact for 8 and 16 bit), x fastest. World space is millimetres with the volume's centre at the
/// origin and the axes along the grid; voxel (i,j,k) sits at (index - (dims-1)/2) * spacing.
struct Volume {
  std::string name;    ///< as the user said it: a path or "shells:128"
  std::string source;  ///< provenance for image metadata: resolved path or generator, one line
  glm::ivec3 dims{0};
  glm::dvec3 spacing{1.0};  ///< mm per voxel, each > 0
  VoxelType stored = VoxelType::F32;
  float min = 0.0f;  ///< over all voxels (finite; NaN and Inf in a file are refused)
  float max = 0.0f;
  std::vector<float> voxels;

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * dims.y + static_cast<std::size_t>(j)) * dims.x + static_cast<std::size_t>(i);
  }
  float at(int i, int j, int k) const { return voxels[index(i, j, k)]; }
  glm::dvec3 position(int i, int j, int k) const {
    return (glm::dvec3(i, j, k) - 0.5 * glm::dvec3(dims - 1)) * spacing;
  }
  /// Edge of the cubic cell that the kernel is scaled to: the largest spacing (docs/decisions.md, "Anisotropic grids").
  double kernel_unit() const { return glm::max(spacing.x, glm::max(spacing.y, spacing.z)); }
  /// Half the diagonal of the box of voxel centres, mm. Independent of the view.
  double bounding_radius() const { return 0.5 * glm::length(glm::dvec3(dims - 1) * spacing); }
};

/// Central differences at a voxel (one-sided at the border), in value per mm.
glm::vec3 gradient(const Volume& volume, int i, int j, int k);

}  // namespace fastsplat::volume
