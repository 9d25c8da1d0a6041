// SPDX-License-Identifier: Apache-2.0
#include "golden/post_classified.hpp"

#include <algorithm>

namespace fastsplat::golden {

PostClassified::PostClassified(const scene::Scene& scene, const SheetGeometry& geometry, double base,
                               std::vector<const PixelStage*> stages)
    : scene_(scene),
      geometry_(geometry),
      classify_(scene.transfer_function, *scene.volume),
      shade_(scene.shading, scene.camera, *scene.volume),
      base_(base),
      stages_(std::move(stages)),
      needs_gradient_(scene.shading.on),
      base_is_clear_(classify_.transparent(base, base)) {}

Run PostClassified::extent(const SheetWindow& window, int, Run so_far) const {
  return base_is_clear_ ? so_far : Run{0, window.here.width()};
}

/// Whether the position is beyond the outermost voxels' cells. Called only if the base value is visible.
bool PostClassified::outside(const glm::dvec3& position) const {
  const glm::dvec3 half = 0.5 * glm::dvec3(scene_.volume->dims) * scene_.volume->spacing;
  return glm::any(glm::greaterThan(glm::abs(scene_.volume->to_grid(position)), half));
}

glm::dvec3 PostClassified::gradient(const SheetWindow& window, int x, int y, double pixels_per_unit) const {
  double across, down, along;  // per kernel unit, times W
  if (scene_.description.gradients == scene::GradientKind::Splats) {
    const Sums& sums = window.here.row(y)[x];
    across = sums[0], down = sums[1], along = sums[2];
  } else {
    // One-sided at the picture's edge.
    const Rows rows = window.here.rows();
    const int left = std::max(x - 1, 0), right = std::min(x + 1, window.here.width() - 1);
    const int above = std::max(y - 1, rows.first), below = std::min(y + 1, rows.end - 1);
    const auto density = [](const Sheet& sheet, int i, int j) { return sheet.row(j)[i][3]; };
    across =
        (density(window.here, right, y) - density(window.here, left, y)) * pixels_per_unit / std::max(right - left, 1);
    down = (density(window.here, x, below) - density(window.here, x, above)) * pixels_per_unit /
           std::max(below - above, 1);
    along = (density(window.behind, x, y) - density(window.before, x, y)) / (2.0 * geometry_.width());
  }
  // `along` follows the pixel's ray; subtracting the ray's sideways part leaves the view axis.
  const glm::dvec2 tilt = geometry_.tilt(x, y);
  const double ahead = along - tilt.x * across - tilt.y * down;
  const scene::Camera& camera = geometry_.camera();
  return (across * camera.right() + down * camera.down() + ahead * camera.direction()) /
         (geometry_.width() * geometry_.unit());
}

void PostClassified::row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const {
  const double width = geometry_.width();
  const double pixels_per_unit = geometry_.pixels_per_unit(window.number);
  for (int i = 0; i < static_cast<int>(pixels.size()); ++i) {
    const int x = begin + i;
    const scene::Material material = classify_.evaluate(base_ + window.here.row(y)[x][3] / width);
    pixels[i] = {};
    if (!(material.extinction > 0.0f)) continue;
    PixelSample sample{geometry_.position(x, y, window.number), glm::dvec3(0.0), glm::dvec3(material.colour)};
    if (!base_is_clear_ && outside(sample.position)) continue;
    if (needs_gradient_) sample.gradient = gradient(window, x, y, pixels_per_unit);
    for (const PixelStage* stage : stages_) stage->apply(sample);
    glm::vec3 colour(sample.colour);
    if (scene_.shading.on) colour = shade_(colour, glm::vec3(sample.gradient));
    const double depth = static_cast<double>(material.extinction) * scene_.description.opacity_scale * width;
    pixels[i] = {colour.r * depth, colour.g * depth, colour.b * depth, depth};
  }
}

}  // namespace fastsplat::golden
