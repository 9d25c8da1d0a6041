#include "tests/driver/oracle/given.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/splats.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::scene_oracle {
namespace {

/// One axis of the grid, walked from its end nearest to the eye.
struct Walk {
  int axis = 0;
  int voxels = 0;
  bool upwards = true;
  int voxel(int step) const { return upwards ? step : voxels - 1 - step; }
};

/// Slices, outer loop, inner loop.
std::array<Walk, 3> walks(const scene::Scene& scene) {
  const glm::dvec3 view = scene.camera.direction();
  int slices = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(view[axis]) >= std::abs(view[slices])) slices = axis;
  const int outer = slices == 2 ? 1 : 2;
  std::array<Walk, 3> all;
  const std::array<int, 3> axes{slices, outer, 3 - slices - outer};
  for (std::size_t i = 0; i < 3; ++i)
    all[i] = {axes[i], scene.volume->dims[axes[i]], view[axes[i]] >= 0.0};  // the view points away from the eye
  return all;
}

}  // namespace

Given given_by(const scene::Scene& scene, const cmodel::Config& config) {
  const volume::Volume& volume = *scene.volume;
  const scene::SceneDescription& description = scene.description;
  Given given;
  given.symbols = test::symbols_of(config);
  given.width = scene.camera.width();
  given.height = scene.camera.height();
  switch (description.method) {
    case scene::Method::ImageAligned:
      given.method = Method::ImageAligned;
      break;
    case scene::Method::AxisAligned:
      given.method = Method::AxisAligned;
      break;
    case scene::Method::XRay:
      given.method = Method::XRay;
      break;
    default:
      throw std::runtime_error("a method that the device does not have");
  }
  given.additive = description.slab_opacity == scene::SlabOpacity::Additive;
  given.xray_sheets = description.xray_sheets;
  given.xray_exposure = description.xray_exposure;
  given.a = scene.kernel.a();
  given.R = scene.kernel.radius();
  given.u = volume.kernel_unit();
  given.D = volume.bounding_radius();
  given.cx = volume.spacing.x / given.u;
  given.cy = volume.spacing.y / given.u;
  given.cz = volume.spacing.z / given.u;
  given.w = description.slab_width;
  given.o = description.opacity_scale;
  const scene::Classifier classify(scene.transfer_function, volume);
  for (const float value : volume.voxels)
    given.kappa = std::max(given.kappa, static_cast<double>(classify(value).extinction));
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const glm::ivec3 last = volume.dims - 1;
    given.scale_at_corner[corner] =
        scene.camera
            .project(volume.position((corner & 1) != 0 ? last.x : 0, (corner & 2) != 0 ? last.y : 0,
                                     (corner & 4) != 0 ? last.z : 0))
            .scale;
  }

  const auto found = scene::collect_splats(scene);
  const auto [slices, outer, inner] = walks(scene);
  given.grid_sheets = slices.voxels;
  for (int g = 0; g < slices.voxels; ++g)
    for (int i = 0; i < outer.voxels; ++i)
      for (int j = 0; j < inner.voxels; ++j) {
        glm::ivec3 voxel;
        voxel[slices.axis] = slices.voxel(g);
        voxel[outer.axis] = outer.voxel(i);
        voxel[inner.axis] = inner.voxel(j);
        if (given.splats.size() == found.size()) continue;
        const scene::Splat& next = found[given.splats.size()];
        if (next.position != glm::vec3(volume.position(voxel.x, voxel.y, voxel.z))) continue;  // an empty voxel
        const scene::ScreenPoint at = scene.camera.project(glm::dvec3(next.position));
        const auto e = glm::dvec3(next.emission);
        given.splats.push_back({at.x, at.y, at.depth, at.scale, {e.r, e.g, e.b, next.extinction}, g});
      }
  if (given.splats.size() != found.size()) throw std::runtime_error("the scene's splats come in another order");
  return given;
}

}  // namespace fastsplat::scene_oracle
