// SPDX-License-Identifier: Apache-2.0
#include "scene/display.hpp"

#include <algorithm>
#include <cassert>

#include "base/srgb.hpp"
#include "scene/scene.hpp"

namespace fastsplat::scene {
namespace {

/// Film negative of linear light: perceptually as far from white as the original is from black.
float negative(float linear) {
  return static_cast<float>(srgb_decode(1.0 - srgb_encode(std::clamp(static_cast<double>(linear), 0.0, 1.0))));
}

}  // namespace

Image displayed(const Image& image, const SceneDescription& description) {
  const glm::vec3 behind(description.display.background);
  const bool invert = description.display.invert && description.method == Method::XRay;
  if (behind == glm::vec3(0.0f) && !invert) return image;
  assert(image.channels == 4);
  Image shown = image;
  for (std::size_t at = 0; at < shown.data.size(); at += 4) {
    float* const pixel = &shown.data[at];
    const float left = 1.0f - std::min(pixel[3], 1.0f);  // an X-ray's alpha may exceed 1
    for (int c = 0; c < 3; ++c) {
      pixel[c] += left * behind[c];
      if (invert) pixel[c] = negative(pixel[c]);
    }
    pixel[3] = 1.0f;
  }
  return shown;
}

}  // namespace fastsplat::scene
