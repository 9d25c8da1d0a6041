// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/oracle/given.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/antialias.hpp"
#include "scene/depth_of_field_splats.hpp"
#include "scene/motion_blur.hpp"
#include "scene/perspective_footprint.hpp"
#include "scene/splats.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::scene_oracle {
namespace {

/// One axis of the grid, walked from its end nearest to the eye (N-8-9).
struct Walk {
  int axis = 0;
  int voxels = 0;
  bool upwards = true;
  int voxel(int step) const { return upwards ? step : voxels - 1 - step; }
};

/// Slices, outer loop, inner loop (N-8-8).
std::array<Walk, 3> walks(const scene::Scene& scene) {
  const glm::dvec3 view = scene.camera.direction();
  int slices = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(view[axis]) >= std::abs(view[slices])) slices = axis;
  const int outer = slices == 2 ? 1 : 2;
  std::array<Walk, 3> all;
  const std::array<int, 3> axes{slices, outer, 3 - slices - outer};
  for (std::size_t i = 0; i < 3; ++i)
    all[i] = {axes[i], scene.volume->dims[axes[i]], view[axes[i]] >= 0.0};  // N-8-9: the view points away from the eye
  return all;
}

/// N-8-24: every line of voxels, walked from its first voxel.
double densest_line(const volume::Volume& volume, const scene::Classifier& classify) {
  double densest = 0.0;
  const auto inside = [&](const glm::ivec3& v) {
    return glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) && glm::all(glm::lessThan(v, volume.dims));
  };
  const auto number = [&](const glm::ivec3& v) {
    return (static_cast<std::size_t>(v.z) * static_cast<std::size_t>(volume.dims.y) + static_cast<std::size_t>(v.y)) *
               static_cast<std::size_t>(volume.dims.x) +
           static_cast<std::size_t>(v.x);
  };
  for (int n = 14; n < 27; ++n) {  // the neighbours that come later in memory
    const glm::ivec3 d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const double step = glm::length(volume.position(d.x, d.y, d.z) - volume.position(0, 0, 0)) / volume.kernel_unit();
    for (glm::ivec3 v(0); v.z < volume.dims.z; ++v.z)
      for (v.y = 0; v.y < volume.dims.y; ++v.y)
        for (v.x = 0; v.x < volume.dims.x; ++v.x) {
          if (inside(v - d)) continue;
          double sum = 0.0;
          for (glm::ivec3 at = v; inside(at); at += d)
            sum += static_cast<double>(classify(volume.voxels[number(at)]).extinction);
          densest = std::max(densest, sum * step);
        }
  }
  return densest;
}

/// N-8-39: each technique of the scene as in golden, in the order of the page.
void shape(const scene::Scene& scene, const glm::dvec3& world, double u, RealSplat& splat) {
  const scene::SceneDescription& description = scene.description;
  const double side = splat.s * u;
  scene::ShapedSplat made{.shape = {side * side, 0.0, side * side}, .value = {}};
  const auto keep = [&] { splat.shapes.push_back({made.shape.xx, made.shape.xy, made.shape.yy}); };
  keep();
  if (description.footprint.shape == scene::FootprintShape::Ellipse) {
    scene::apply_perspective(scene.camera, world, splat.z, made);
    keep();
  }
  if (description.footprint.antialias) {
    scene::apply_antialias(side, made);
    keep();
  }
  scene::MotionBlur(description.motion, scene.camera, scene.kernel).apply(world, made);
  keep();
  scene::DepthOfFieldSplats(description.lens, scene.camera, scene.kernel).apply(splat.z, made);
  keep();
  splat.lambda = made.depth_growth;
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
    case scene::Method::Westover:
      given.method = Method::Westover;
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
  given.L = densest_line(volume, classify);
  for (std::size_t corner = 0; corner < 8; ++corner) {  // N-8-25
    const glm::ivec3 last = volume.dims - 1;
    given.scale_at_corner[corner] =
        scene.camera
            .project(volume.position((corner & 1) != 0 ? last.x : 0, (corner & 2) != 0 ? last.y : 0,
                                     (corner & 4) != 0 ? last.z : 0))
            .scale;
  }

  const scene::FootprintSettings& footprint = description.footprint;
  given.shapes = footprint.shape == scene::FootprintShape::Ellipse || footprint.antialias ||
                 !description.motion.none() || description.lens.depth_of_field == scene::DepthOfField::Splats;
  const auto slabs_more = [&](double depth) {  // N-8-55
    return std::ceil((scene::depth_growth(scene, depth) - 1.0) * given.R / given.w);
  };
  given.slabs_before = slabs_more(-given.D);
  given.slabs_behind = slabs_more(given.D);

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
        const scene::ScreenPoint at = scene.camera.project(glm::dvec3(next.position));  // N-8-5: of the rounded place
        const auto e = glm::dvec3(next.emission);
        given.splats.push_back({at.x, at.y, at.depth, at.scale, {e.r, e.g, e.b, next.extinction}, g, i, j, {}, 1.0});
        if (given.shapes) shape(scene, glm::dvec3(next.position), given.u, given.splats.back());
      }
  if (given.splats.size() != found.size()) throw std::runtime_error("the scene's splats come in another order");
  return given;
}

}  // namespace fastsplat::scene_oracle
