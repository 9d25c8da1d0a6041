// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/splats.hpp"

namespace fastsplat::scene {
namespace {

/// One grid axis, walked from its end nearest to the eye.
struct Walk {
  int axis;
  int extent;
  bool ascending;

  int index(int step) const { return ascending ? step : extent - 1 - step; }
};

/// View direction in the grid's axes.
glm::dvec3 direction_in_grid(const Scene& scene) { return scene.volume->to_grid(scene.camera.direction()); }

Walk walk_along(int axis, const Scene& scene) {
  return {axis, scene.volume->dims[axis], direction_in_grid(scene)[axis] >= 0.0};
}

/// The axis most parallel to the view; of equal ones the last, which costs the fewest cache misses.
int dominant_axis(const Scene& scene) {
  const glm::dvec3 along = glm::abs(direction_in_grid(scene));
  int axis = 2;
  if (along.y > along[axis]) axis = 1;
  if (along.x > along[axis]) axis = 0;
  return axis;
}

/// Slices first, then the remaining axes with the one that is nearer in memory innermost.
std::array<Walk, 3> walk_order(const Scene& scene) {
  const int slice = dominant_axis(scene);
  const int row = slice == 2 ? 1 : 2;
  return {walk_along(slice, scene), walk_along(row, scene), walk_along(3 - slice - row, scene)};
}

}  // namespace

VoxelSplats::VoxelSplats(const Scene& scene, SplatKind kind, Classifier classifier)
    : scene_(scene),
      kind_(kind),
      classify_(std::move(classifier)),
      shade_(scene.shading, scene.camera, *scene.volume),
      least_(scene.volume->min),
      density_(1.0 / ((static_cast<double>(scene.volume->max) - scene.volume->min) * scene.description.slab_width)),
      opacity_scale_(static_cast<float>(scene.description.opacity_scale)),
      textured_(scene.description.texture.kind != SolidKind::None &&
                scene.description.texture.where == TextureWhere::Voxel),
      shaded_(scene.shading.on && kind == SplatKind::Colours) {
  const Walk slices = walk_along(dominant_axis(scene), scene);
  slice_axis_ = slices.axis;
  last_slice_ = slices.extent - 1;
  ascending_ = slices.ascending;
}

UnlitSplat VoxelSplats::unlit(const glm::ivec3& at, const glm::dvec3& position, const Material& material,
                              float extinction) const {
  UnlitSplat out{.colour = material.colour, .extinction = extinction, .surface = {}};
  if (textured_) out.colour *= glm::vec3(tint(scene_.description.texture, position));
  if (shaded_) out.surface = shade_.surface(at.x, at.y, at.z);
  return out;
}

struct Traversal::State {
  const Scene& scene;
  VoxelSplats splat;
  std::array<Walk, 3> order;

  State(const Scene& of, SplatKind what) : scene(of), splat(of, what), order(walk_order(of)) {}

  template <class Each, class EndRow>
  void walk(const GridPart& part, Each each, EndRow end_row) const;
};

Traversal::Traversal(const Scene& scene, SplatKind kind) : state_(std::make_unique<const State>(scene, kind)) {}
Traversal::~Traversal() = default;

int Traversal::slices() const { return state_->order[0].extent; }
int Traversal::rows() const { return state_->order[1].extent; }
int Traversal::columns() const { return state_->order[2].extent; }

/// Calls each(at, line, material, extinction) for every non-empty voxel of the part, end_row() after each row.
template <class Each, class EndRow>
void Traversal::State::walk(const GridPart& part, Each each, EndRow end_row) const {
  // Local copies: members would be reloaded for every voxel, since other code might write to them.
  const VoxelSplats voxel = splat;
  const std::array<Walk, 3> axes = order;
  const volume::Volume& volume = *scene.volume;
  glm::ivec3 at;
  for (int slice = part.first_slice; slice < part.end_slice; ++slice) {
    at[axes[0].axis] = axes[0].index(slice);
    for (int row = part.first_row; row < part.end_row; ++row) {
      at[axes[1].axis] = axes[1].index(row);
      for (int step = 0; step < axes[2].extent; ++step) {
        at[axes[2].axis] = axes[2].index(step);
        Material material;
        const float extinction = voxel.extinction(volume.at(at.x, at.y, at.z), material);
        if (extinction > 0.0f) each(at, static_cast<std::uint32_t>(row * axes[2].extent + step), material, extinction);
      }
      end_row();
    }
  }
}

std::size_t Traversal::count(const GridPart& part) const {
  std::size_t splats = 0;
  state_->walk(
      part, [&splats](const glm::ivec3&, std::uint32_t, const Material&, float) { ++splats; }, [] {});
  return splats;
}

void Traversal::visit(const GridPart& part, const Visit& visit) const {
  const volume::Volume& volume = *state_->scene.volume;
  std::vector<Splat> splats;
  std::vector<std::uint32_t> lines;
  state_->walk(
      part,
      [&](const glm::ivec3& at, std::uint32_t line, const Material& material, float extinction) {
        splats.push_back(state_->splat(at, volume.position(at.x, at.y, at.z), material, extinction));
        lines.push_back(line);
      },
      [&] {
        if (splats.empty()) return;
        visit(splats, lines);
        splats.clear();
        lines.clear();
      });
}

std::vector<Splat> collect_splats(const Scene& scene) {
  std::vector<Splat> splats;
  for_each_splat(scene, [&splats](const Splat& splat) { splats.push_back(splat); });
  return splats;
}

int axis_sheet_count(const Scene& scene) { return scene.volume->dims[dominant_axis(scene)]; }

}  // namespace fastsplat::scene
