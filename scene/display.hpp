// What is done to a picture only for looking at it: a background, an X-ray turned dark on bright.
#pragma once

#include <glm/glm.hpp>

#include "base/image.hpp"

namespace fastsplat::scene {

struct SceneDescription;

struct Display {
  glm::dvec3 background{0.0};  ///< linear RGB, 0..1; black: nothing is put behind
  bool invert = false;         ///< X-ray: its negative, dark on bright as films are looked at
};

/// A rendered picture (RGBA, premultiplied, linear) as it is shown: the background behind it, then inverted. Where
/// neither is asked for it is the picture itself; else it is opaque. The negative is taken of sRGB values: 255 minus
/// those of the PNG.
Image displayed(const Image& image, const SceneDescription& description);

}  // namespace fastsplat::scene
