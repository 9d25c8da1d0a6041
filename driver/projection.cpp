#include "driver/projection.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

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

/// The splats of a part of the grid.
struct Piece {
  scene::GridPart part;
  std::vector<QuantisedSplat> splats;
  std::vector<std::size_t> ends;    ///< per slice of the part, of its splats
  std::vector<std::size_t> places;  ///< likewise, of the frame's splats: where the slice's begin
  std::uint64_t voxels = 0, saturated = 0, vanished = 0;
  double asked = 0.0, lost = 0.0;

  void add(const SplatQuantiser::Result& one, int slice) {
    while (part.first_slice + static_cast<int>(ends.size()) < slice) ends.push_back(splats.size());
    ++voxels;
    asked += one.asked;
    if (one.splat.words == SplatWords{}) {
      ++vanished;
      lost += one.asked;
      return;
    }
    saturated += one.saturated ? 1 : 0;
    splats.push_back(one.splat);
  }
  void end() { ends.resize(static_cast<std::size_t>(part.end_slice - part.first_slice), splats.size()); }
  std::span<const QuantisedSplat> slice(int slice) const {
    if (slice < part.first_slice || slice >= part.end_slice) return {};
    const auto i = static_cast<std::size_t>(slice - part.first_slice);
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(splats).subspan(begin, ends[i] - begin);
  }
};

/// Parts that do not depend on each other: slabs of slices, or, where a splat needs to know what those before it in its
/// line left, bands of rows. Their number is not that of the threads: no sum depends on that.
std::vector<Piece> pieces_of(const scene::Traversal& traversal, bool bands) {
  constexpr int kPieces = 32;
  const int extent = bands ? traversal.rows() : traversal.slices(), count = std::min(extent, kPieces);
  std::vector<Piece> pieces(static_cast<std::size_t>(count));
  for (int n = 0; n < count; ++n) {
    scene::GridPart& part = pieces[static_cast<std::size_t>(n)].part = traversal.all();
    (bands ? part.first_row : part.first_slice) = n * extent / count;
    (bands ? part.end_row : part.end_slice) = (n + 1) * extent / count;
  }
  return pieces;
}

/// In traversal order: slice by slice, of each one piece after the other.
Uninitialised<QuantisedSplat> joined(std::vector<Piece>& pieces, int slices, int threads) {
  std::size_t total = 0;
  for (int slice = 0; slice < slices; ++slice) {
    for (Piece& piece : pieces) {
      if (slice < piece.part.first_slice || slice >= piece.part.end_slice) continue;
      piece.places.push_back(total);
      total += piece.slice(slice).size();
    }
  }
  Uninitialised<QuantisedSplat> out(total);
  parallel_for(pieces.size(), threads, [&](std::size_t number) {
    Piece& piece = pieces[number];
    for (int slice = piece.part.first_slice; slice < piece.part.end_slice; ++slice) {
      const std::size_t place = piece.places[static_cast<std::size_t>(slice - piece.part.first_slice)];
      std::ranges::copy(piece.slice(slice), out.begin() + static_cast<std::ptrdiff_t>(place));
    }
    piece.splats = {};  // a frame is in memory once, not twice
  });
  return out;
}

}  // namespace

RadiusSets radius_sets(const scene::Scene& scene, const cmodel::Config& config) {
  const RadiusRange range = radius_range(scene);
  return RadiusSets(config, range.smallest, range.largest);
}

Projected project(const scene::Scene& scene, const cmodel::Config& config, const Slices& slices,
                  const scene::SheetPlan& plan, int threads) {
  Projected out{.splats = {}, .sets = radius_sets(scene, config)};
  const SplatQuantiser quantised(scene, config, out.sets, slices, plan);
  const scene::Traversal traversal(scene);
  out.carried = quantised.carries();

  std::vector<Piece> pieces = pieces_of(traversal, out.carried);
  parallel_for(pieces.size(), threads, [&](std::size_t number) {
    Piece& piece = pieces[number];
    if (out.carried) {
      RoundingCarry carry = quantised.carry(piece.part.first_row, piece.part.end_row, traversal.columns());
      traversal.visit(piece.part, [&](const scene::Splat& splat, std::uint32_t line) {
        piece.add(quantised(scene::real_splat(scene, splat), line, carry), splat.sheet);
      });
    } else {
      traversal.visit(piece.part, [&](const scene::Splat& splat, std::uint32_t) {
        piece.add(quantised(scene::real_splat(scene, splat)), splat.sheet);
      });
    }
    piece.end();
  });

  double asked = 0.0, lost = 0.0;
  for (const Piece& piece : pieces) {
    out.voxels += piece.voxels;
    out.saturated += piece.saturated;
    out.vanished += piece.vanished;
    asked += piece.asked;
    lost += piece.lost;
  }
  out.vanished_share = out.carried || asked == 0.0 ? 0.0 : lost / asked;
  out.splats = joined(pieces, traversal.slices(), threads);
  return out;
}

}  // namespace fastsplat::driver
