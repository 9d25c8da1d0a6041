// SPDX-License-Identifier: Apache-2.0
#include "golden/density_splats.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "golden/sheet_geometry.hpp"
#include "scene/ripple.hpp"

namespace fastsplat::golden {
namespace {

constexpr int kBrick = 4;  // voxels along an edge

/// For each brick, the largest value within reach_voxels of it or a little farther.
class BrickMaxima {
 public:
  BrickMaxima(const volume::Volume& volume, const glm::ivec3& reach_voxels)
      : bricks_((volume.dims + (kBrick - 1)) / kBrick),
        largest_(static_cast<std::size_t>(bricks_.x) * bricks_.y * bricks_.z, -std::numeric_limits<float>::infinity()) {
    const float* value = volume.voxels.data();
    for (int k = 0; k < volume.dims.z; ++k) {
      for (int j = 0; j < volume.dims.y; ++j) {
        for (int i = 0; i < volume.dims.x; ++i, ++value) {
          float& largest = largest_[index({i / kBrick, j / kBrick, k / kBrick})];
          largest = std::max(largest, *value);
        }
      }
    }
    for (int axis = 0; axis < 3; ++axis) spread(axis, (reach_voxels[axis] + kBrick - 1) / kBrick);
  }

  glm::ivec3 bricks() const { return bricks_; }
  std::size_t index(const glm::ivec3& b) const {
    return (static_cast<std::size_t>(b.z) * bricks_.y + b.y) * bricks_.x + b.x;
  }
  float operator[](std::size_t brick) const { return largest_[brick]; }

 private:
  void spread(int axis, int reach) {
    const std::vector<float> before = largest_;
    glm::ivec3 b;
    for (b.z = 0; b.z < bricks_.z; ++b.z) {
      for (b.y = 0; b.y < bricks_.y; ++b.y) {
        for (b.x = 0; b.x < bricks_.x; ++b.x) {
          glm::ivec3 other = b;
          const int last = std::min(b[axis] + reach, bricks_[axis] - 1);
          for (other[axis] = std::max(b[axis] - reach, 0); other[axis] <= last; ++other[axis]) {
            largest_[index(b)] = std::max(largest_[index(b)], before[index(other)]);
          }
        }
      }
    }
  }

  glm::ivec3 bricks_;
  std::vector<float> largest_;
};

/// Largest tilt of any ray: always that of a ray at a corner of the image.
double largest_tilt(const SheetGeometry& geometry) {
  const scene::Camera& camera = geometry.camera();
  double largest = 0.0;
  for (const double x : {0.0, camera.width() - 1.0}) {
    for (const double y : {0.0, camera.height() - 1.0}) largest = std::max(largest, glm::length(geometry.tilt(x, y)));
  }
  return largest;
}

/// Largest distance between two voxels that affect the same pixel's density or gradient, kernel units. A pixel's
/// density takes voxels within R across and R + W in depth; its gradient takes those of the next pixel and sheet.
double influence(const scene::Scene& scene, const SheetGeometry& geometry) {
  const double radius = scene.kernel.radius();
  const double pixel = 1.0 / geometry.pixels_per_unit(geometry.sheets() - 1);
  const double across = 2.0 * radius + pixel;
  const double along = 2.0 * radius + 3.0 * geometry.width();
  // Over a slab's depth a tilted ray also moves across.
  return std::hypot(across + largest_tilt(geometry) * along, along);
}

/// Extent of a ball of radius 1 along each of the grid's axes: more than 1 if the grid is sheared.
glm::dvec3 reach_across(const volume::Volume& volume) {
  if (!volume.oblique) return glm::dvec3(1.0);
  const glm::dmat3 rows = glm::transpose(volume.across);
  return {glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2])};
}

}  // namespace

DensityField collect_densities(const scene::Scene& scene, bool skip) {
  const volume::Volume& volume = *scene.volume;
  const SheetGeometry geometry(scene);
  const scene::Classifier classify(scene.transfer_function, volume);
  const glm::ivec3 reach(
      glm::ceil(influence(scene, geometry) * geometry.unit() * reach_across(volume) / volume.spacing));
  // The reach of grown and elliptical footprints and the largest sum of textured ones are not computed: skip nothing.
  const scene::FootprintSettings& footprint = scene.description.footprint;
  skip = skip && footprint.shape == scene::FootprintShape::Circle && !footprint.antialias &&
         !(footprint.texture.amplitude > 0.0);
  const BrickMaxima maxima(volume, skip ? reach : glm::ivec3(0));
  const double most = 1.0 + scene::ripple_bound(scene.kernel, largest_tilt(geometry));

  DensityField field;
  field.base = volume.min;
  std::vector<bool> dropped(static_cast<std::size_t>(maxima.bricks().x) * maxima.bricks().y * maxima.bricks().z);
  for (std::size_t b = 0; skip && b < dropped.size(); ++b) {
    dropped[b] = classify.transparent(field.base, field.base + most * (maxima[b] - field.base));
  }

  for (int k = 0; k < volume.dims.z; ++k) {
    for (int j = 0; j < volume.dims.y; ++j) {
      for (int i = 0; i < volume.dims.x; ++i) {
        const float value = volume.at(i, j, k) - volume.min;
        if (!(value > 0.0f)) continue;
        if (dropped[maxima.index({i / kBrick, j / kBrick, k / kBrick})]) {
          ++field.skipped;
          continue;
        }
        field.splats.push_back({.position = glm::vec3(volume.position(i, j, k)),
                                .emission = glm::vec3(0.0f),
                                .extinction = value,
                                .sheet = 0});
      }
    }
  }
  return field;
}

}  // namespace fastsplat::golden
