#include <algorithm>
#include <array>
#include <cmath>

#include "scene/shading.hpp"
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

/// The view's direction in the grid's own axes: slices of one index lie one behind the other along it.
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

void for_each_splat(const Scene& scene, const std::function<void(const Splat&)>& visit) {
  const volume::Volume& volume = *scene.volume;
  const Classifier classify(scene.transfer_function, volume);
  const Shader shade(scene.shading, scene.camera, volume);
  const float opacity_scale = static_cast<float>(scene.description.opacity_scale);
  const auto order = walk_order(scene);
  const Texture& texture = scene.description.texture;
  const bool textured = texture.kind != SolidKind::None && texture.where == TextureWhere::Voxel;

  glm::ivec3 at;
  for (int slice = 0; slice < order[0].extent; ++slice) {
    at[order[0].axis] = order[0].index(slice);
    for (int row = 0; row < order[1].extent; ++row) {
      at[order[1].axis] = order[1].index(row);
      for (int step = 0; step < order[2].extent; ++step) {
        at[order[2].axis] = order[2].index(step);
        const Material material = classify(volume.at(at.x, at.y, at.z));
        const float extinction = material.extinction * opacity_scale;
        if (!(extinction > 0.0f)) continue;
        const glm::dvec3 position = volume.position(at.x, at.y, at.z);
        glm::vec3 colour = material.colour;
        if (textured) colour *= glm::vec3(tint(texture, position));
        if (scene.shading.on) colour = shade(colour, at.x, at.y, at.z);
        visit({.position = glm::vec3(position),
               .emission = glm::min(colour * extinction, glm::vec3(extinction)),
               .extinction = extinction,
               .sheet = static_cast<std::uint16_t>(slice)});
      }
    }
  }
}

std::vector<Splat> collect_splats(const Scene& scene) {
  std::vector<Splat> splats;
  for_each_splat(scene, [&splats](const Splat& splat) { splats.push_back(splat); });
  return splats;
}

int axis_sheet_count(const Scene& scene) { return scene.volume->dims[dominant_axis(scene)]; }

}  // namespace fastsplat::scene
