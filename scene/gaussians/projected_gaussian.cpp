// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/projected_gaussian.hpp"

#include <algorithm>
#include <cmath>

#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

/// Largest distance from the axis, in half pictures, at which the projection is linearised. Farther out the
/// linearisation is useless and footprints would grow without bound.
constexpr double kWidest = 1.3;

glm::dvec3 world_position(const GaussianScene& scene, const Gaussian& gaussian) {
  return scene.turn * (glm::dvec3(gaussian.position) - scene.middle);
}

/// The camera's axes as the rows of W.
glm::dmat3 view_of(const Camera& camera) {
  return glm::transpose(glm::dmat3(camera.right(), camera.down(), camera.direction()));
}

/// J Sigma_view J^T for the upper two rows of J.
ScreenShape squeezed(const glm::dmat3& sigma, const glm::dvec3& row_x, const glm::dvec3& row_y) {
  return {glm::dot(row_x, sigma * row_x), glm::dot(row_x, sigma * row_y), glm::dot(row_y, sigma * row_y)};
}

ScreenShape shape_of(const GaussianScene& scene, const glm::dmat3& sigma, const glm::dvec3& view, double scale) {
  const Camera& camera = scene.camera;
  if (camera.projection() == Projection::Orthographic) return squeezed(sigma, {scale, 0, 0}, {0, scale, 0});
  // x = f X / Z: dx = f/Z dX - f X/Z^2 dZ, with f/Z the scale there.
  const double distance = camera.eye_distance() + view.z, focal = scale * distance;
  const double widest_x = kWidest * 0.5 * camera.width() / focal, widest_y = kWidest * 0.5 * camera.height() / focal;
  const double along_x = std::clamp(view.x / distance, -widest_x, widest_x);
  const double along_y = std::clamp(view.y / distance, -widest_y, widest_y);
  return squeezed(sigma, {scale, 0, -scale * along_x}, {0, scale, -scale * along_y});
}

bool meets_picture(const GaussianScene& scene, const ProjectedGaussian& splat) {
  const double cutoff = scene.description.cutoff;
  const double across = cutoff * std::sqrt(splat.shape.xx), down = cutoff * std::sqrt(splat.shape.yy);
  return splat.x + across > 0.0 && splat.x - across < scene.camera.width() - 1.0 && splat.y + down > 0.0 &&
         splat.y - down < scene.camera.height() - 1.0;
}

}  // namespace

bool project(const GaussianScene& scene, std::uint32_t number, ProjectedGaussian& out) {
  const Gaussian& gaussian = scene.cloud->gaussians[number];
  const Camera& camera = scene.camera;
  const glm::dvec3 world = world_position(scene, gaussian);
  const glm::dmat3 to_view = view_of(camera);
  const glm::dvec3 view = to_view * world;
  const bool perspective = camera.projection() == Projection::Perspective;
  if (perspective && camera.eye_distance() + view.z < kNear * camera.eye_distance()) return false;

  const ScreenPoint at = camera.project(world);
  const glm::dmat3 turn = to_view * scene.turn;
  const glm::dmat3 sigma = turn * covariance(gaussian) * glm::transpose(turn);
  ScreenShape shape = shape_of(scene, sigma, view, at.scale);
  const double unfiltered = std::max(shape.determinant(), 0.0);
  shape.xx += scene.description.low_pass;
  shape.yy += scene.description.low_pass;
  const double dimmed = scene.cloud->antialiased ? std::sqrt(unfiltered / shape.determinant()) : 1.0;

  // From the eye to the Gaussian, in the file's axes: the argument of its harmonics.
  const glm::dvec3 from_eye =
      perspective ? glm::normalize(world + camera.eye_distance() * camera.direction()) : camera.direction();
  out = {.number = number,
         .x = at.x,
         .y = at.y,
         .depth = at.depth,
         .shape = shape,
         .opacity = std::min(dimmed * static_cast<double>(gaussian.opacity), kMostAlpha),
         .colour = colour_at(scene.cloud->harmonics_of(number), glm::transpose(scene.turn) * from_eye)};
  return true;
}

std::vector<ProjectedGaussian> project_all(const GaussianScene& scene, ProjectionReport* report) {
  ProjectionReport counts{.gaussians = scene.cloud->gaussians.size()};
  std::vector<ProjectedGaussian> out;
  ProjectedGaussian splat;
  for (std::uint32_t number = 0; number < scene.cloud->gaussians.size(); ++number) {
    if (!project(scene, number, splat)) {
      ++counts.near;
    } else if (!meets_picture(scene, splat)) {
      ++counts.outside;
    } else {
      out.push_back(splat);
    }
  }
  std::ranges::stable_sort(out, {}, &ProjectedGaussian::depth);
  if (report != nullptr) *report = counts;
  return out;
}

double depth_of_maximum(const GaussianScene& scene, const ProjectedGaussian& splat, double x, double y) {
  const Gaussian& gaussian = scene.cloud->gaussians[splat.number];
  const Ray ray = scene.camera.ray(x, y);
  // In the Gaussian's own axes, each divided by its deviation, this is the point of the line nearest to the origin.
  const glm::dmat3 to_own = glm::transpose(scene.turn * axes_of(gaussian));
  glm::dvec3 way = to_own * ray.direction, start = to_own * (world_position(scene, gaussian) - ray.origin);
  constexpr double kFlattest = 1e-3;
  const auto longest = static_cast<double>(std::max({gaussian.scale.x, gaussian.scale.y, gaussian.scale.z}));
  if (!(longest > 0.0)) return splat.depth;
  for (int axis = 0; axis < 3; ++axis) {
    const double deviation = std::max(static_cast<double>(gaussian.scale[axis]), kFlattest * longest);
    way[axis] /= deviation;
    start[axis] /= deviation;
  }
  return ray.depth_per_mm * glm::dot(way, start) / glm::dot(way, way);
}

}  // namespace fastsplat::scene
