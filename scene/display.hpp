// SPDX-License-Identifier: Apache-2.0
// Changes to a picture for display only: a background, an inverted X-ray.
#pragma once

#include <glm/glm.hpp>

#include "base/image.hpp"

namespace fastsplat::scene {

struct SceneDescription;

struct Display {
  glm::dvec3 background{0.0};  ///< linear RGB, 0..1; black: no background
  bool invert = false;         ///< X-ray: the negative, dark on bright as on film
};

/// Prepares a rendered picture (RGBA, premultiplied, linear) for display: puts it over the background, then inverts it.
/// Returns it unchanged if neither applies; else the result is opaque. The negative is taken of sRGB values: 255 minus
/// those of the PNG.
Image displayed(const Image& image, const SceneDescription& description);

}  // namespace fastsplat::scene
