// Bands of image rows: the unit of parallel work. A pixel belongs to one band, and a band meets its splats in an order
// that depends on the scene alone; so the bits of the image do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "golden/footprint.hpp"
#include "golden/projected_splat.hpp"

namespace fastsplat::golden {

/// Few enough that a band's ring of sheets stays in cache, and enough that most splats lie in one band.
inline constexpr int kBandRows = 16;

int band_count(int image_height);
Rows band_rows(int band, int image_height);

/// Runs work(band) for every band on `threads` threads (0: all cores), in any order. More threads than cores are
/// honoured.
void for_each_band(int image_height, int threads, const Progress& progress, const std::function<void(int band)>& work);

/// For every band the indices of the splats that reach into it, sorted by key; equal keys stay in the order given.
class BandIndex {
 public:
  /// key(splat) in [0, keys).
  BandIndex(const scene::Scene& scene, const std::vector<scene::Splat>& splats, int keys,
            const std::function<int(const ProjectedSplat&)>& key);

  std::span<const std::uint32_t> bucket(int band, int key) const {
    const std::size_t cell = static_cast<std::size_t>(band) * keys_ + key;
    return std::span(indices_).subspan(start_[cell], start_[cell + 1] - start_[cell]);
  }

 private:
  std::size_t keys_;
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace fastsplat::golden
