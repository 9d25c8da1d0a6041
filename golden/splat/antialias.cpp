#include "golden/splat/antialias.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace fastsplat::golden {

scene::SlabGrid slabs_for_grown_kernels(const scene::Scene& scene) {
  scene::SlabGrid grid = scene::slab_grid(scene);
  const auto slabs_more = [&](double depth) {
    return std::ceil((depth_growth(scene, depth) - 1.0) * scene.kernel.radius() / grid.width);
  };
  const double before = slabs_more(-scene.volume->bounding_radius());
  const double behind = slabs_more(scene.volume->bounding_radius());
  if (!(before + behind <= kMostSlabsMore)) {
    throw_usage({.where = {},
                 .what = "anti-aliasing: a pixel holds so many voxels that their kernels reach too many slabs",
                 .expected = fmt::format("at most {} more", kMostSlabsMore),
                 .got = fmt::format("{:.6g}", before + behind),
                 .fix = "raise --zoom, --size or --slab-width"});
  }
  grid.first -= before * grid.width;
  grid.count += static_cast<int>(before + behind);
  return grid;
}

}  // namespace fastsplat::golden
