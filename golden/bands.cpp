#include "golden/bands.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel/parallel.hpp"
#include "golden/splat/projection.hpp"

namespace fastsplat::golden {

void for_each_band(const Bands& bands, int threads, const Progress& progress,
                   const std::function<void(int band)>& work) {
  const auto count = static_cast<std::size_t>(bands.count());
  std::atomic<std::size_t> done = 0;
  parallel_for(count, threads, [&](std::size_t band) {
    work(static_cast<int>(band));
    const std::size_t finished = ++done;
    if (progress) progress(finished, count);
  });
}

BandRange bands_of(const ProjectedSplat& splat, const Bands& bands, int width) {
  const double left = std::ceil(splat.x - splat.reach_x);
  const double right = std::floor(splat.x + splat.reach_x);
  const double top = std::max(std::ceil(splat.y - splat.reach_y), 0.0);
  const double bottom = std::min(std::floor(splat.y + splat.reach_y), bands.image_height - 1.0);
  if (right < 0.0 || left > width - 1.0 || top > bottom) return {};
  return {static_cast<int>(top) / bands.rows_per_band, static_cast<int>(bottom) / bands.rows_per_band + 1};
}

// A stable counting sort: count every bucket, turn the counts into starts, fill.
BandIndex::BandIndex(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const Bands& bands, int keys,
                     const std::function<int(const ProjectedSplat&)>& key)
    : keys_(static_cast<std::size_t>(keys)) {
  const int width = scene.camera.width();
  const Projector project(scene);
  assert(splats.size() <= std::numeric_limits<std::uint32_t>::max());
  const auto for_each_cell = [&](const auto& visit) {
    for (std::size_t i = 0; i < splats.size(); ++i) {
      const ProjectedSplat splat = project(splats[i]);
      const BandRange reached = bands_of(splat, bands, width);
      if (reached.first == reached.end) continue;
      const auto splat_key = static_cast<std::size_t>(key(splat));
      for (int band = reached.first; band < reached.end; ++band) visit(band * keys_ + splat_key, i);
    }
  };

  start_.assign(bands.count() * keys_ + 1, 0);
  for_each_cell([&](std::size_t cell, std::size_t) { ++start_[cell + 1]; });
  for (std::size_t cell = 1; cell < start_.size(); ++cell) start_[cell] += start_[cell - 1];

  indices_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for_each_cell(
      [&](std::size_t cell, std::size_t splat) { indices_[next[cell]++] = static_cast<std::uint32_t>(splat); });
}

}  // namespace fastsplat::golden
