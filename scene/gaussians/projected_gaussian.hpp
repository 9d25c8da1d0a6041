// SPDX-License-Identifier: Apache-2.0
// Gaussians culled, projected (EWA), coloured and sorted for a camera: the input of golden and of the driver's
// quantisation.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/progress.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/shaped_splat.hpp"

namespace fastsplat::scene {

/// Largest opacity of a sample.
inline constexpr double kMostAlpha = 0.99;
/// Early-termination threshold on transmittance.
inline constexpr double kFinished = 1e-4;

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

/// Counts of the Gaussians of a cloud by their fate.
struct ProjectionReport {
  std::uint64_t gaussians = 0;  ///< of the cloud
  std::uint64_t near = 0;       ///< behind the near plane
  std::uint64_t outside = 0;    ///< whose footprint meets no pixel
  std::uint64_t degenerate = 0;  ///< so long and thin that their shape is lost in the rounding of doubles; left out
};

/// Projects one Gaussian. Returns false if it is nearer than the near plane; nothing else is culled here.
bool project(const GaussianScene& scene, std::uint32_t number, ProjectedGaussian& out);

/// The Gaussians that meet a pixel and are not degenerate, nearest first by GaussianScene::order; equal ones in the
/// order of the file. `threads` (0: all cores) never change them.
std::vector<ProjectedGaussian> project_all(const GaussianScene& scene, ProjectionReport* report = nullptr,
                                           int threads = 0, const Progress& progress = {});

/// The depth at which a Gaussian is densest on the ray through a pixel. Flat ones count as thick as a thousandth of
/// their length.
double depth_of_maximum(const GaussianScene& scene, const ProjectedGaussian& splat, double x, double y);

}  // namespace fastsplat::scene
