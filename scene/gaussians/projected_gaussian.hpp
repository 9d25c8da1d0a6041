// Gaussians where the camera puts them: culled, projected (EWA), coloured, sorted. What golden draws and the driver
// quantises.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/shaped_splat.hpp"

namespace fastsplat::scene {

/// No sample is more opaque.
inline constexpr double kMostAlpha = 0.99;
/// A pixel of less transmittance is finished.
inline constexpr double kFinished = 1e-4;
/// Nearer to the eye than this share of the scene's distance is not drawn.
inline constexpr double kNear = 0.01;

struct ProjectedGaussian {
  std::uint32_t number = 0;  ///< in the cloud
  double x = 0.0, y = 0.0;   ///< of the centre, pixels
  double depth = 0.0;        ///< of the centre along the view axis; larger is farther
  ScreenShape shape;         ///< Sigma', square pixels, the low-pass in it
  double opacity = 0.0;      ///< at the centre, at most kMostAlpha
  glm::dvec3 colour{0.0};    ///< not below 0; may exceed 1

  /// d^T Sigma'^-1 d.
  double q(double dx, double dy) const {
    return (shape.yy * dx * dx - 2.0 * shape.xy * dx * dy + shape.xx * dy * dy) / shape.determinant();
  }
};

/// What became of the Gaussians of a cloud.
struct ProjectionReport {
  std::uint64_t gaussians = 0;  ///< of the cloud
  std::uint64_t near = 0;       ///< behind the near plane
  std::uint64_t outside = 0;    ///< whose footprint meets no pixel
};

/// One Gaussian; nothing but `near` is culled here: false where it lies behind the near plane.
bool project(const GaussianScene& scene, std::uint32_t number, ProjectedGaussian& out);

/// Those that meet a pixel, nearest first; of the same depth in the order of the file.
std::vector<ProjectedGaussian> project_all(const GaussianScene& scene, ProjectionReport* report = nullptr);

/// Where along the view axis a Gaussian is densest on the ray through a pixel. Flat ones are taken as thick as a
/// thousandth of their length.
double depth_of_maximum(const GaussianScene& scene, const ProjectedGaussian& splat, double x, double y);

}  // namespace fastsplat::scene
