#include "driver/projection.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel/parallel.hpp"

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
                  const scene::SheetPlan& plan, int threads) {
  const RadiusRange range = radius_range(scene);
  Projected out{.splats = {}, .sets = RadiusSets(config, range.smallest, range.largest)};
  const SplatQuantiser quantised(scene, config, out.sets, slices, plan);
  const scene::Traversal traversal(scene);

  // Slabs of the grid, each on its own, put together in their order.
  struct Piece {
    std::vector<QuantisedSplat> splats;
    std::uint64_t voxels = 0, saturated = 0, vanished = 0;
  };
  std::vector<Piece> pieces(static_cast<std::size_t>(std::min(traversal.slices(), 32)));
  parallel_for(pieces.size(), threads, [&](std::size_t number) {
    Piece& piece = pieces[number];
    const auto cut = [&](std::size_t n) {
      return static_cast<int>(n * static_cast<std::size_t>(traversal.slices()) / pieces.size());
    };
    traversal.visit(cut(number), cut(number + 1), [&](const scene::Splat& splat) {
      ++piece.voxels;
      bool saturated = false;
      const QuantisedSplat words = quantised(scene::real_splat(scene, splat), saturated);
      if (words.words == SplatWords{}) {
        ++piece.vanished;
        return;
      }
      piece.saturated += saturated ? 1 : 0;
      piece.splats.push_back(words);
    });
  });
  std::size_t total = 0;
  for (const Piece& piece : pieces) total += piece.splats.size();
  out.splats.reserve(total);
  for (Piece& piece : pieces) {
    out.voxels += piece.voxels;
    out.saturated += piece.saturated;
    out.vanished += piece.vanished;
    out.splats.insert(out.splats.end(), piece.splats.begin(), piece.splats.end());
    piece.splats = {};
  }
  return out;
}

}  // namespace fastsplat::driver
