// SPDX-License-Identifier: Apache-2.0
// Gaussians and a view of them: everything that decides the picture (docs/techniques/gaussians.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/camera.hpp"
#include "scene/gaussians/gaussian_cloud.hpp"
#include "scene/gaussians/placed_camera.hpp"
#include "scene/voxel_box.hpp"

namespace fastsplat::scene {

const std::vector<std::string>& up_axis_names();  ///< in the order of UpAxis: x, y, z, -x, -y, -z

/// Both included.
struct Limits {
  double low, high;
};
inline constexpr Limits kLowPassLimits{0.01, 100.0}, kCutoffLimits{1.0, 4.0}, kNearLimits{1e-6, 1e6};
/// Least depth before the eye: of an orbiting camera, as a share of its distance; of a placed one, in the scene's unit,
/// as Kerbl et al. draw.
inline constexpr double kNearShare = 0.01, kNearPlaced = 0.2;

/// Nearest first: by the depth of centres along the view axis, or by their distance from the eye.
enum class GaussianSort { Depth, Distance };

struct GaussianDescription {
  CameraParams camera{};
  std::optional<PlacedCamera> placed{};  ///< instead; of `camera` then only roll and field of view are used, if at all
  std::optional<double> near{};          ///< absent: kNearShare or kNearPlaced
  std::optional<GaussianSort> order{};   ///< absent: as the cloud declares
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
  double near = 0.0;    ///< least depth before the eye
  GaussianSort order = GaussianSort::Depth;
};

/// The axis of a scene that declares none: z of a built-in one, -y of a file.
UpAxis usual_up(const std::string& name_or_path);

/// Removes Gaussians whose centres are outside. UserError (Usage) if none is inside.
void crop(GaussianCloud& cloud, const RealBox& box);

/// Throws UserError (Usage) if the description exceeds its limits.
GaussianScene build_gaussian_scene(const GaussianDescription& description, std::shared_ptr<const GaussianCloud> cloud);
/// The same cloud from another camera or in another size; nothing else of `description` may differ.
GaussianScene seen_by(const GaussianDescription& description, const GaussianScene& scene);

}  // namespace fastsplat::scene
