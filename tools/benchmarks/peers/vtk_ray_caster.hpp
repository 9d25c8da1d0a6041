// VTK's fixed-point ray caster on a scene of ours: the same volume, camera, transfer function and light.
#pragma once

#include <memory>

#include "base/image.hpp"
#include "scene/scene.hpp"

namespace fastsplat::bench {

/// One thread, density as one component, classified at each sample, trilinear, a sample and a ray per voxel and pixel:
/// the mapper's own quality settings, none of which is left to its stop-watch. No window is opened and no light
/// or camera is changed between frames, so that from the second frame on its gradients and tables are kept.
class VtkRayCaster {
 public:
  /// The scene outlives it: orthographic, unrolled or not, of an unturned grid.
  explicit VtkRayCaster(const scene::Scene& scene);
  /// `densities` in the place of the scene's volume, around the same centre and in its units; a sample every `step`
  /// kernel units. They are copied.
  VtkRayCaster(const scene::Scene& scene, const volume::Volume& densities, double step);
  ~VtkRayCaster();

  void draw();
  /// The last frame: premultiplied, rows downwards.
  Image picture() const;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace fastsplat::bench
