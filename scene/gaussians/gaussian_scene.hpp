// SPDX-License-Identifier: Apache-2.0
// Gaussians and a view of them: everything that decides the picture (docs/techniques/gaussians.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/camera.hpp"
#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

const std::vector<std::string>& up_axis_names();  ///< in the order of UpAxis: x, y, z, -x, -y, -z

/// Both included.
struct Limits {
  double low, high;
};
inline constexpr Limits kLowPassLimits{0.01, 100.0}, kCutoffLimits{1.0, 4.0};

struct GaussianDescription {
  CameraParams camera{};
  int width = 512, height = 512;
  UpAxis up = UpAxis::MinusY;
  double low_pass = 0.3;  ///< square pixels added to each projected variance
  double cutoff = 3.0;    ///< reach of a footprint, standard deviations
};

/// World: the file's axes turned so that `up` is z, its origin in the scene's middle.
struct GaussianScene {
  GaussianDescription description;
  std::shared_ptr<const GaussianCloud> cloud;
  glm::dmat3 turn;      ///< from the file's axes
  glm::dvec3 middle;    ///< in the file's axes: medians of the positions
  double radius = 1.0;  ///< of the sphere about it that holds 95 % of the Gaussians with their cutoff
  Camera camera;        ///< zoom 1 fits that sphere
};

/// The axis of a scene that declares none: z of a built-in one, -y of a file.
UpAxis usual_up(const std::string& name_or_path);

/// Throws UserError (Usage) if the description exceeds its limits.
GaussianScene build_gaussian_scene(const GaussianDescription& description, std::shared_ptr<const GaussianCloud> cloud);

}  // namespace fastsplat::scene
