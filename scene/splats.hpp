// SPDX-License-Identifier: Apache-2.0
// Voxel traversal: the non-empty voxels of a scene as classified, shaded splats, front to back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "scene/shading.hpp"
#include "scene/transfer_function.hpp"

namespace fastsplat::scene {

/// One voxel's kernel, pre-classified and pre-shaded.
struct Splat {
  glm::vec3 position;   ///< mm, world
  glm::vec3 emission;   ///< colour * extinction, per kernel unit, each <= extinction
  float extinction;     ///< per kernel unit, > 0
  std::uint16_t sheet;  ///< axis-aligned sheet number, 0 nearest to the eye
};

/// The part of a voxel's splat that does not depend on the view.
struct UnlitSplat {
  glm::vec3 colour;
  float extinction;  ///< per kernel unit, > 0
  Surface surface;
};

/// A part of the grid in traversal order: slices first_slice..end_slice-1, 0 nearest to the eye, and in each the rows
/// first_row..end_row-1 of its outer loop.
struct GridPart {
  int first_slice = 0, end_slice = 0;
  int first_row = 0, end_row = 0;
};

/// The material of a voxel's splat. Colours: emission and extinction from the transfer function. Densities: every voxel
/// above the volume's least value has an extinction, namely its height above it, as a fraction of the range, divided by
/// the slab's width W. A slab's sums are then densities from 0 (the least value) to about 1 (the largest).
enum class SplatKind { Colours, Densities };

/// Makes the splats of single voxels, with the grid's slices as Traversal counts them.
class VoxelSplats {
 public:
  /// The scene must outlive this object.
  explicit VoxelSplats(const Scene& scene, SplatKind kind = SplatKind::Colours)
      : VoxelSplats(scene, kind, Classifier(scene.transfer_function, *scene.volume)) {}
  /// The same with the scene's classifier, whose making may visit all voxels.
  VoxelSplats(const Scene& scene, SplatKind kind, Classifier classifier);
  /// The extinction of a splat with this value, and its material; 0: the voxel has no splat.
  float extinction(float value, Material& material) const {
    if (kind_ == SplatKind::Densities) {
      material = Material{};
      return static_cast<float>((static_cast<double>(value) - least_) * density_);
    }
    material = classify_(value);
    return material.extinction * opacity_scale_;
  }
  /// Whether no voxel with a value of [low, high] has a splat.
  bool transparent(float low, float high) const {
    return kind_ == SplatKind::Densities ? !(high > least_) : classify_.transparent(low, high);
  }
  int slice(const glm::ivec3& at) const { return ascending_ ? at[slice_axis_] : last_slice_ - at[slice_axis_]; }
  /// The splat of a voxel at `position`, with what extinction() returned.
  Splat operator()(const glm::ivec3& at, const glm::dvec3& position, const Material& material, float extinction) const {
    return {.position = glm::vec3(position),
            .emission = emission(unlit(at, position, material, extinction)),
            .extinction = extinction,
            .sheet = static_cast<std::uint16_t>(slice(at))};
  }
  // The same in two steps.
  UnlitSplat unlit(const glm::ivec3& at, const glm::dvec3& position, const Material& material, float extinction) const;
  glm::vec3 emission(const UnlitSplat& splat) const {
    const glm::vec3 colour = shaded_ ? shade_(splat.colour, splat.surface) : splat.colour;
    return glm::min(colour * splat.extinction, glm::vec3(splat.extinction));
  }

 private:
  const Scene& scene_;
  SplatKind kind_;
  Classifier classify_;
  Shader shade_;
  double least_, density_;
  float opacity_scale_;
  bool textured_, shaded_;
  int slice_axis_, last_slice_;
  bool ascending_;
};

/// Every voxel with extinction > 0, slice by slice along the volume axis most parallel to the view direction, nearest
/// slice first; inside a slice by the remaining axes, also nearest first. The order is a function of the scene only.
/// For Method::XRay the order is the same (it does not matter there). Parts may be visited by several threads at once.
class Traversal {
 public:
  /// The scene must outlive this object.
  explicit Traversal(const Scene& scene, SplatKind kind = SplatKind::Colours);
  ~Traversal();
  /// Number of sheets of the grid, for Splat::sheet.
  int slices() const;
  int rows() const;     ///< of a slice: its outer loop
  int columns() const;  ///< of a row: its inner loop
  GridPart all() const { return slab(0, slices()); }
  GridPart slab(int first_slice, int end_slice) const { return {first_slice, end_slice, 0, rows()}; }
  /// Number of splats that visit() would visit; classifies, but does not shade.
  std::size_t count(const GridPart& part) const;
  /// Receives the splats of a row. `lines` holds, for each, the number of its voxel's line across the slices: row times
  /// columns() plus column.
  using Visit = std::function<void(std::span<const Splat> splats, std::span<const std::uint32_t> lines)>;
  /// Called once for every row with splats.
  void visit(const GridPart& part, const Visit& visit) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

/// Visits all splats one by one.
template <class Each>
void for_each_splat(const Scene& scene, Each each) {
  const Traversal traversal(scene);
  traversal.visit(traversal.all(), [&each](std::span<const Splat> splats, std::span<const std::uint32_t>) {
    for (const Splat& splat : splats) each(splat);
  });
}

std::vector<Splat> collect_splats(const Scene& scene);

/// The grid's extent along its dominant axis: Splat::sheet is below it.
int axis_sheet_count(const Scene& scene);

}  // namespace fastsplat::scene
