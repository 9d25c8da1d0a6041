// SPDX-License-Identifier: Apache-2.0
// VTK's fixed-point ray caster on one of our scenes: the same volume, camera, transfer function and light.
#pragma once

#include <memory>

#include "base/image.hpp"
#include "scene/scene.hpp"

namespace fastsplat::bench {

/// One thread, density as one component, classified at each sample, trilinear, one sample and ray per voxel and pixel.
/// All of the mapper's quality settings are fixed, none depends on its timer. No window is opened. From the second
/// frame on gradients are reused, and tables unless look() moves the light.
class VtkRayCaster {
 public:
  /// `scene` must outlive it and be orthographic, with or without roll, of a non-oblique grid.
  explicit VtkRayCaster(const scene::Scene& scene);
  /// Uses `densities` instead of the scene's volume, with the same centre and units, and a sample every `step` kernel
  /// units. Copies them.
  VtkRayCaster(const scene::Scene& scene, const volume::Volume& densities, double step);
  ~VtkRayCaster();

  /// Takes camera and light of another scene of the same volume.
  void look(const scene::Scene& scene);
  void draw();
  /// The last frame: premultiplied, rows downwards.
  Image picture() const;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace fastsplat::bench
