// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/projected_gaussian.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel/parallel.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

/// Largest distance from the middle of the picture, in half pictures, at which the projection is linearised. Farther
/// out the linearisation is useless and footprints would grow without bound.
constexpr double kWidest = 1.3;

glm::dvec3 world_position(const GaussianScene& scene, const Gaussian& gaussian) {
  return scene.turn * (glm::dvec3(gaussian.position) - scene.middle);
}

/// What all Gaussians of a view share.
struct View {
  glm::dmat3 to_view;  ///< W: the camera's axes as its rows
  glm::dmat3 turn;     ///< from the file's axes to the camera's
  glm::dmat3 turn_back, file_axes;

  explicit View(const GaussianScene& scene)
      : to_view(glm::transpose(glm::dmat3(scene.camera.right(), scene.camera.down(), scene.camera.direction()))),
        turn(to_view * scene.turn),
        turn_back(glm::transpose(turn)),
        file_axes(glm::transpose(scene.turn)) {}
};

/// J Sigma_view J^T for the upper two rows of J.
ScreenShape squeezed(const glm::dmat3& sigma, const glm::dvec3& row_x, const glm::dvec3& row_y) {
  return {glm::dot(row_x, sigma * row_x), glm::dot(row_x, sigma * row_y), glm::dot(row_y, sigma * row_y)};
}

ScreenShape shape_of(const GaussianScene& scene, const glm::dmat3& sigma, const glm::dvec3& view, double scale) {
  const Camera& camera = scene.camera;
  if (camera.projection() == Projection::Orthographic) return squeezed(sigma, {scale, 0, 0}, {0, scale, 0});
  // x = f X / Z: dx = f/Z dX - f X/Z^2 dZ, with f/Z the scale there.
  const double distance = camera.eye_distance() + view.z, focal = scale * distance;
  const double scale_y = scale * camera.stretch();
  const double width = kWidest * 0.5 * camera.width(), height = kWidest * 0.5 * camera.height();
  const glm::dvec2 off = camera.centre() - 0.5 * glm::dvec2(camera.width() - 1, camera.height() - 1);
  const double focal_y = focal * camera.stretch();
  const double along_x = std::clamp(view.x / distance, (-width - off.x) / focal, (width - off.x) / focal);
  const double along_y = std::clamp(view.y / distance, (-height - off.y) / focal_y, (height - off.y) / focal_y);
  return squeezed(sigma, {scale, 0, -scale * along_x}, {0, scale_y, -scale_y * along_y});
}

bool meets_picture(const GaussianScene& scene, const ProjectedGaussian& splat) {
  const double cutoff = scene.description.cutoff;
  const double across = cutoff * std::sqrt(splat.shape.xx), down = cutoff * std::sqrt(splat.shape.yy);
  return splat.x + across > 0.0 && splat.x - across < scene.camera.width() - 1.0 && splat.y + down > 0.0 &&
         splat.y - down < scene.camera.height() - 1.0;
}

/// What Gaussians are sorted by.
double order_of(const GaussianScene& scene, const ProjectedGaussian& splat) {
  const Camera& camera = scene.camera;
  if (scene.order == GaussianSort::Depth || camera.projection() == Projection::Orthographic) return splat.depth;
  return (camera.eye_distance() + splat.depth) / camera.ray(splat.x, splat.y).depth_per_mm;
}

/// Whether the determinant, a difference of two products, has no more than ten right bits.
bool is_degenerate(const ScreenShape& shape) {
  constexpr double kLost = 0x1p-42;
  return !(shape.determinant() > kLost * shape.xx * shape.yy);
}

bool project(const GaussianScene& scene, const View& seen, std::uint32_t number, ProjectedGaussian& out) {
  const Gaussian& gaussian = scene.cloud->gaussians[number];
  const Camera& camera = scene.camera;
  const glm::dvec3 world = world_position(scene, gaussian);
  const glm::dvec3 view = seen.to_view * world - camera.depth_zero();
  const bool perspective = camera.projection() == Projection::Perspective;
  if (perspective && camera.eye_distance() + view.z < scene.near) return false;

  const ScreenPoint at = camera.project(world);
  const glm::dmat3 sigma = seen.turn * covariance(gaussian) * seen.turn_back;
  ScreenShape shape = shape_of(scene, sigma, view, at.scale);
  const double unfiltered = std::max(shape.determinant(), 0.0);
  shape.xx += scene.description.low_pass;
  shape.yy += scene.description.low_pass;
  const double dimmed = scene.cloud->antialiased ? std::sqrt(unfiltered / shape.determinant()) : 1.0;

  // From the eye to the Gaussian, in the file's axes: the argument of its harmonics.
  const glm::dvec3 from_eye = perspective ? glm::normalize(world - camera.eye()) : camera.direction();
  out = {.number = number,
         .x = at.x,
         .y = at.y,
         .depth = at.depth,
         .shape = shape,
         .opacity = std::min(dimmed * static_cast<double>(gaussian.opacity), kMostAlpha),
         .colour = colour_at(scene.cloud->harmonics_of(number), seen.file_axes * from_eye)};
  return true;
}

}  // namespace

bool project(const GaussianScene& scene, std::uint32_t number, ProjectedGaussian& out) {
  return project(scene, View(scene), number, out);
}

std::vector<ProjectedGaussian> project_all(const GaussianScene& scene, ProjectionReport* report, int threads,
                                           const Progress& progress) {
  const std::size_t count = scene.cloud->gaussians.size();
  struct Part {
    std::vector<ProjectedGaussian> splats;
    ProjectionReport counts;
  };
  std::vector<Part> parts(part_count(count));
  const View seen(scene);
  std::atomic<std::size_t> done{0};
  parallel_parts(count, threads, [&](std::size_t number, std::size_t first, std::size_t end) {
    Part& part = parts[number];
    ProjectedGaussian splat;
    for (std::size_t i = first; i < end; ++i) {
      if (!project(scene, seen, static_cast<std::uint32_t>(i), splat)) {
        ++part.counts.near;
      } else if (!meets_picture(scene, splat)) {
        ++part.counts.outside;
      } else if (is_degenerate(splat.shape)) {
        ++part.counts.degenerate;
      } else {
        part.splats.push_back(splat);
      }
    }
    if (progress) progress(++done, parts.size());
  });
  ProjectionReport counts{.gaussians = count};
  std::vector<double> depths;
  std::vector<const ProjectedGaussian*> all;
  for (const Part& part : parts) {
    counts.near += part.counts.near;
    counts.outside += part.counts.outside;
    counts.degenerate += part.counts.degenerate;
    for (const ProjectedGaussian& splat : part.splats) {
      depths.push_back(order_of(scene, splat));
      all.push_back(&splat);
    }
  }
  const std::vector<std::uint32_t> order = stable_order(depths, threads);
  std::vector<ProjectedGaussian> out(order.size());
  parallel_parts(out.size(), threads, [&](std::size_t, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) out[i] = *all[order[i]];
  });
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
