// SPDX-License-Identifier: Apache-2.0
#include "golden/collect_splats.hpp"

#include <algorithm>

#include "base/parallel/parallel.hpp"

namespace fastsplat::golden {

std::vector<scene::Splat> collect_splats(const scene::Scene& scene, int threads) {
  const scene::Traversal traversal(scene);
  const auto slices = static_cast<std::size_t>(traversal.slices());
  constexpr std::size_t kMostPieces = 64;
  const std::size_t pieces = std::min(slices, kMostPieces);
  const auto slab = [&](std::size_t piece) {
    return traversal.slab(static_cast<int>(piece * slices / pieces), static_cast<int>((piece + 1) * slices / pieces));
  };

  std::vector<std::size_t> start(pieces + 1, 0);
  parallel_for(pieces, threads, [&](std::size_t piece) { start[piece + 1] = traversal.count(slab(piece)); });
  for (std::size_t piece = 0; piece < pieces; ++piece) start[piece + 1] += start[piece];

  std::vector<scene::Splat> splats(start[pieces]);
  parallel_for(pieces, threads, [&](std::size_t piece) {
    scene::Splat* next = splats.data() + start[piece];
    traversal.visit(slab(piece), [&next](std::span<const scene::Splat> row, std::span<const std::uint32_t>) {
      next = std::copy(row.begin(), row.end(), next);
    });
  });
  return splats;
}

}  // namespace fastsplat::golden
