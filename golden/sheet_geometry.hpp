// SPDX-License-Identifier: Apache-2.0
// World positions of the pixels of image-aligned sheets.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::golden {

class SheetGeometry {
 public:
  explicit SheetGeometry(const scene::Scene& scene)
      : camera_(scene.camera),
        grid_(scene::sheet_plan(scene, scene::Method::ImageAligned).slabs),
        unit_(scene.volume->kernel_unit()) {}

  int sheets() const { return grid_.count; }
  double width() const { return grid_.width; }                                     ///< kernel units
  double unit() const { return unit_; }                                            ///< mm
  double near_side(int sheet) const { return grid_.first + sheet * grid_.width; }  ///< depth, kernel units
  double depth_mm(int sheet) const {
    return (near_side(sheet) + 0.5 * grid_.width) * unit_;
  }  ///< of the sheet's middle
  /// Scale at the depth of the sheet's middle.
  double pixels_per_unit(int sheet) const {
    return camera_.project(camera_.direction() * depth_mm(sheet)).scale * unit_;
  }

  /// World position, mm, where a pixel's ray passes the sheet's middle.
  glm::dvec3 position(double x, double y, int sheet) const {
    const scene::Ray ray = camera_.ray(x, y);
    return ray.origin + ray.direction * (depth_mm(sheet) / ray.depth_per_mm);
  }

  /// How far a pixel's ray moves right (x) and down (y) per unit of depth; 0 for orthographic cameras.
  glm::dvec2 tilt(double x, double y) const {
    const scene::Ray ray = camera_.ray(x, y);
    return glm::dvec2(glm::dot(ray.direction, camera_.right()), glm::dot(ray.direction, camera_.down())) /
           ray.depth_per_mm;
  }

  const scene::Camera& camera() const { return camera_; }

 private:
  const scene::Camera& camera_;
  scene::SlabGrid grid_;
  double unit_;
};

}  // namespace fastsplat::golden
