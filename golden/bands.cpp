#include "golden/bands.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace fastsplat::golden {

int band_count(int image_height) { return (image_height + kBandRows - 1) / kBandRows; }

Rows band_rows(int band, int image_height) {
  return {band * kBandRows, std::min((band + 1) * kBandRows, image_height)};
}

void for_each_band(int image_height, int threads, const Progress& progress, const std::function<void(int band)>& work) {
  const int bands = band_count(image_height);
  std::atomic<std::size_t> done = 0;
  const auto run = [&](const tbb::blocked_range<int>& range) {
    for (int band = range.begin(); band < range.end(); ++band) {
      work(band);
      const std::size_t finished = ++done;
      if (progress) progress(finished, static_cast<std::size_t>(bands));
    }
  };
  // TBB hands out no more workers than cores unless told otherwise (and complains on stderr).
  std::optional<tbb::global_control> allow;
  if (threads > tbb::info::default_concurrency()) {
    allow.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(tbb::blocked_range<int>(0, bands, 1), run, tbb::simple_partitioner()); });
}

namespace {

struct BandRange {
  int first = 0;
  int end = 0;  ///< first == end: outside the image
};

BandRange bands_of(const ProjectedSplat& splat, int width, int height) {
  const double left = std::ceil(splat.x - splat.radius);
  const double right = std::floor(splat.x + splat.radius);
  const double top = std::max(std::ceil(splat.y - splat.radius), 0.0);
  const double bottom = std::min(std::floor(splat.y + splat.radius), height - 1.0);
  if (right < 0.0 || left > width - 1.0 || top > bottom) return {};
  return {static_cast<int>(top) / kBandRows, static_cast<int>(bottom) / kBandRows + 1};
}

}  // namespace

// A stable counting sort: count every bucket, turn the counts into starts, fill.
BandIndex::BandIndex(const scene::Scene& scene, const std::vector<scene::Splat>& splats, int keys,
                     const std::function<int(const ProjectedSplat&)>& key)
    : keys_(static_cast<std::size_t>(keys)) {
  const int width = scene.camera.width();
  const int height = scene.camera.height();
  const auto for_each_cell = [&](const auto& visit) {
    for (std::size_t i = 0; i < splats.size(); ++i) {
      const ProjectedSplat splat = project(scene, splats[i]);
      const BandRange bands = bands_of(splat, width, height);
      if (bands.first == bands.end) continue;
      const auto splat_key = static_cast<std::size_t>(key(splat));
      for (int band = bands.first; band < bands.end; ++band) visit(band * keys_ + splat_key, i);
    }
  };

  start_.assign(band_count(height) * keys_ + 1, 0);
  for_each_cell([&](std::size_t cell, std::size_t) { ++start_[cell + 1]; });
  for (std::size_t cell = 1; cell < start_.size(); ++cell) start_[cell] += start_[cell - 1];

  indices_.resize(start_.back());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for_each_cell(
      [&](std::size_t cell, std::size_t splat) { indices_[next[cell]++] = static_cast<std::uint32_t>(splat); });
}

}  // namespace fastsplat::golden
