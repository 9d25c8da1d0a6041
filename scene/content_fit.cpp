// SPDX-License-Identifier: Apache-2.0
#include "scene/content_fit.hpp"

#include <algorithm>
#include <limits>

namespace fastsplat::scene {
namespace {

struct Rectangle {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void include(const ScreenPoint& at, double radius_mm) {
    const glm::dvec2 point(at.x, at.y), reach(radius_mm * at.scale);
    low = glm::min(low, point - reach);
    high = glm::max(high, point + reach);
  }
};

}  // namespace

Camera fitted_to_content(const Scene& scene, double zoom) {
  const volume::Volume& volume = *scene.volume;
  const Classifier classify(scene.transfer_function, volume);
  const double radius = scene.kernel.radius() * volume.kernel_unit();
  const auto seen = [&](int i, int j, int k) { return classify(volume.at(i, j, k)).extinction > 0.0f; };
  Rectangle all;
  for (int k = 0; k < volume.dims.z; ++k) {
    for (int j = 0; j < volume.dims.y; ++j) {
      // Coordinates and scale are monotone along a row, so its ends reach farthest.
      int first = 0, last = volume.dims.x - 1;
      while (first <= last && !seen(first, j, k)) ++first;
      if (first > last) continue;
      while (!seen(last, j, k)) --last;
      for (const int i : {first, last}) all.include(scene.camera.project(volume.position(i, j, k)), radius);
    }
  }
  if (!(all.high.x > all.low.x)) return scene.camera;
  const glm::dvec2 size(scene.camera.width(), scene.camera.height());
  const glm::dvec2 room = size / (all.high - all.low);
  return scene.camera.enlarged(zoom * std::min(room.x, room.y), 0.5 * (all.low + all.high));
}

}  // namespace fastsplat::scene
