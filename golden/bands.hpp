// SPDX-License-Identifier: Apache-2.0
// Bands of image rows: the unit of parallel work. Each pixel belongs to one band, and the order of a band's splats
// depends on the scene alone. So the image does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "golden/splat/footprint.hpp"
#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

struct Bands {
  int image_height = 0;
  /// Default: few enough to keep a band's ring of sheets in cache, enough that most splats lie in one band.
  int rows_per_band = 16;

  int count() const { return (image_height + rows_per_band - 1) / rows_per_band; }
  Rows rows(int band) const { return {band * rows_per_band, std::min((band + 1) * rows_per_band, image_height)}; }
};

/// Runs work(band) for every band, in any order, on `threads` threads (0: all cores; may exceed the number of cores).
void for_each_band(const Bands& bands, int threads, const Progress& progress,
                   const std::function<void(int band)>& work);
/// The same, bands of the largest `cost` first, so that no thread finishes last with a long one.
void for_each_band(std::span<const std::uint64_t> cost, int threads, const Progress& progress,
                   const std::function<void(int band)>& work);

struct BandRange {
  int first = 0;
  int end = 0;  ///< first == end: outside the image
};
/// The bands that the splat's footprint may reach.
BandRange bands_of(const ProjectedSplat& splat, const Bands& bands, int width);

/// For each band, the indices of the splats that reach it, sorted by key. Splats of equal key keep their order.
class BandIndex {
 public:
  /// key(splat) must be in [0, keys); it is called from several threads. At most 2^32 - 1 splats.
  BandIndex(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const Bands& bands, int keys,
            int threads, const std::function<int(const ProjectedSplat&)>& key);

  std::span<const std::uint32_t> bucket(int band, int key) const {
    const std::size_t cell = static_cast<std::size_t>(band) * keys_ + key;
    return std::span(indices_).subspan(start_[cell], start_[cell + 1] - start_[cell]);
  }
  std::size_t size() const { return indices_.size(); }  ///< over all bands
  /// Number of splats that reach each band.
  std::vector<std::uint64_t> splats_per_band() const;

 private:
  std::size_t bands_, keys_;
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace fastsplat::golden
