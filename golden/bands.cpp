// SPDX-License-Identifier: Apache-2.0
#include "golden/bands.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel/parallel.hpp"
#include "golden/splat/projection.hpp"

namespace fastsplat::golden {

namespace {

/// Wraps `work` to report the number of finished bands.
std::function<void(std::size_t)> counted(std::size_t count, const Progress& progress,
                                         const std::function<void(int band)>& work, std::atomic<std::size_t>& done) {
  return [count, &progress, &work, &done](std::size_t band) {
    work(static_cast<int>(band));
    const std::size_t finished = ++done;
    if (progress) progress(finished, count);
  };
}

}  // namespace

void for_each_band(const Bands& bands, int threads, const Progress& progress,
                   const std::function<void(int band)>& work) {
  const auto count = static_cast<std::size_t>(bands.count());
  std::atomic<std::size_t> done = 0;
  parallel_for(count, threads, counted(count, progress, work, done));
}

void for_each_band(std::span<const std::uint64_t> cost, int threads, const Progress& progress,
                   const std::function<void(int band)>& work) {
  std::atomic<std::size_t> done = 0;
  parallel_for(cost, threads, counted(cost.size(), progress, work, done));
}

BandRange bands_of(const ProjectedSplat& splat, const Bands& bands, int width) {
  const double left = std::ceil(splat.x - splat.reach_x);
  const double right = std::floor(splat.x + splat.reach_x);
  const double top = std::max(std::ceil(splat.y - splat.reach_y), 0.0);
  const double bottom = std::min(std::floor(splat.y + splat.reach_y), bands.image_height - 1.0);
  if (right < 0.0 || left > width - 1.0 || top > bottom) return {};
  return {static_cast<int>(top) / bands.rows_per_band, static_cast<int>(bottom) / bands.rows_per_band + 1};
}

// A stable counting sort: find every splat's place, count every bucket, turn the counts into starts, fill. Places are
// kept because finding one costs a projection and storing it only 8 bytes.
BandIndex::BandIndex(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const Bands& bands, int keys,
                     int threads, const std::function<int(const ProjectedSplat&)>& key)
    : bands_(static_cast<std::size_t>(bands.count())), keys_(static_cast<std::size_t>(keys)) {
  struct Place {
    std::int32_t key = 0;
    std::uint16_t first = 0, end = 0;  ///< bands
  };
  const int width = scene.camera.width();
  const Projector project(scene);
  assert(splats.size() <= std::numeric_limits<std::uint32_t>::max());
  assert(bands.count() <= std::numeric_limits<std::uint16_t>::max());
  std::vector<Place> places(splats.size());
  constexpr std::size_t kPiece = 1 << 14;
  parallel_for((splats.size() + kPiece - 1) / kPiece, threads, [&](std::size_t piece) {
    for (std::size_t i = piece * kPiece; i < std::min(splats.size(), (piece + 1) * kPiece); ++i) {
      const ProjectedSplat splat = project(splats[i]);
      const BandRange reached = bands_of(splat, bands, width);
      if (reached.first == reached.end) continue;
      places[i] = {key(splat), static_cast<std::uint16_t>(reached.first), static_cast<std::uint16_t>(reached.end)};
    }
  });
  const auto for_each_cell = [&](const auto& visit) {
    for (std::size_t i = 0; i < splats.size(); ++i) {
      const Place place = places[i];
      for (std::size_t band = place.first; band < place.end; ++band) {
        visit(band * keys_ + static_cast<std::size_t>(place.key), i);
      }
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

std::vector<std::uint64_t> BandIndex::splats_per_band() const {
  std::vector<std::uint64_t> splats(bands_);
  for (std::size_t band = 0; band < bands_; ++band) splats[band] = start_[(band + 1) * keys_] - start_[band * keys_];
  return splats;
}

}  // namespace fastsplat::golden
