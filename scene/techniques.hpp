// SPDX-License-Identifier: Apache-2.0
// Techniques that shape a splat's footprint on the screen: perspective, minification, motion, a lens.
// scene/capability.hpp lists the engines that have them, docs/techniques/ has a page for each.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/camera.hpp"

namespace fastsplat::scene {

enum class FootprintShape {
  Circle,   ///< of the splat's own scale
  Ellipse,  ///< the kernel's sphere in perspective, local affine projection
};

/// Detail inside every footprint. A splat cycles through `phases` pictures of it, frame by frame.
struct SplatTexture {
  int phases = 16;
  double amplitude = 0.0;  ///< 0: plain splats; 1: weights vary from 0 to twice the footprint
  int frame = 0;
  double scale = 0.5;  ///< size of the detail, kernel units
};

struct FootprintSettings {
  FootprintShape shape = FootprintShape::Circle;
  bool antialias = false;  ///< kernels never shrink below one pixel per voxel on the screen
  SplatTexture texture{};
};

/// The motion while the shutter is open, from -1/2 to +1/2 about the picture's moment.
struct Motion {
  glm::dvec3 translate{0.0};  ///< mm, world: displacement of the volume
  double orbit = 0.0;         ///< degrees of azimuth that the camera turns, ending at azimuth + orbit/2

  bool none() const { return translate == glm::dvec3(0.0) && orbit == 0.0; }
};

enum class DepthOfField { Off, Splats, Sheets };

/// A thin lens focused on a plane. The field of view fixes the size of the picture, so the focal length cancels:
/// docs/techniques/depth-of-field.md.
struct Lens {
  DepthOfField depth_of_field = DepthOfField::Off;
  double aperture = 0.0;  ///< mm, diameter
  double focus = 0.0;     ///< mm along the view axis from the volume's centre, positive is farther
};

/// Diameter of the circle of confusion at `depth`, pixels: A |s(depth) - s(focus)|, s the camera's pixels per mm.
double circle_of_confusion(const Camera& camera, const Lens& lens, double depth);

/// Throws UserError (Usage) if the numbers are invalid for this camera; scene/capability checks combinations. `radius`
/// is that of the ball that holds all kernels, mm.
void check_techniques(const Motion& motion, const Lens& lens, const Camera& camera, double radius);

const std::vector<std::string>& footprint_shape_names();  ///< in the order of FootprintShape
const std::vector<std::string>& depth_of_field_names();   ///< in the order of DepthOfField

}  // namespace fastsplat::scene
