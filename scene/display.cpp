#include "scene/display.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/scene.hpp"

namespace fastsplat::scene {
namespace {

/// The curve of sRGB, there and back.
double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}
double from_srgb(double shown) { return shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4); }

/// Of linear light what a film's negative shows: a grey as far from white as this is from black, to the eye.
float negative(float linear) {
  return static_cast<float>(from_srgb(1.0 - to_srgb(std::clamp(static_cast<double>(linear), 0.0, 1.0))));
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
