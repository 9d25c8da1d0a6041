#include "driver/projection.hpp"

#include <algorithm>
#include <limits>

namespace fastsplat::driver {
namespace {

struct RadiusRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
};

/// Footprint radii over the corners of the volume's box: scale is monotone in depth, so the corners bound it.
RadiusRange radius_range(const scene::Scene& scene) {
  const volume::Volume& volume = *scene.volume;
  RadiusRange range;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at =
        volume.position((corner & 1) != 0 ? volume.dims.x - 1 : 0, (corner & 2) != 0 ? volume.dims.y - 1 : 0,
                        (corner & 4) != 0 ? volume.dims.z - 1 : 0);
    const double radius = pixel_radius(scene, scene.camera.project(at).scale);
    range.smallest = std::min(range.smallest, radius);
    range.largest = std::max(range.largest, radius);
  }
  return range;
}

}  // namespace

Projected project(const scene::Scene& scene, const cmodel::Config& config, const Slices& slices,
                  const scene::SheetPlan& plan) {
  const RadiusRange range = radius_range(scene);
  Projected out{.splats = {}, .sets = RadiusSets(config, range.smallest, range.largest)};
  const SplatQuantiser quantised(scene, config, out.sets, slices, plan);
  scene::for_each_splat(scene, [&](const scene::Splat& splat) {
    ++out.voxels;
    bool saturated = false;
    const QuantisedSplat words = quantised(scene::real_splat(scene, splat), saturated);
    if (words.words == SplatWords{}) {
      ++out.vanished;
      return;
    }
    out.saturated += saturated ? 1 : 0;
    out.splats.push_back(words);
  });
  return out;
}

}  // namespace fastsplat::driver
