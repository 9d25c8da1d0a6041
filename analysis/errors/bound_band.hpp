// SPDX-License-Identifier: Apache-2.0
// The bound on a band of image rows. A forward pass finds what each layer shows, a backward pass what lies behind it;
// then each rounding is bounded splat by splat (docs/errors.md, section 3).
#pragma once

#include <span>
#include <vector>

#include "analysis/errors/bound_layer.hpp"
#include "analysis/errors/bound_slices.hpp"
#include "analysis/errors/bound_weights.hpp"
#include "analysis/pipeline/band_bins.hpp"

namespace fastsplat::analysis {

/// The layers of a pixel are the sheets; or, if every sample is composited, the splats that may have a weight there.
class BoundBand {
 public:
  /// Keeps references. `splats` are binned by the first sheet that each may reach.
  BoundBand(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings,
            const KnownSplats& splats, golden::Rows rows, int width);

  void run(const stages::BandBins& bins, int band);
  const std::vector<PixelBound>& pixels() const { return pixels_; }  ///< row by row
  const Terms& terms() const { return terms_; }                      ///< sums over values

 private:
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y - rows_.first) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  /// The known sums of each pixel's layers.
  void fill_sheets(std::uint32_t splat);
  void fill_samples(std::uint32_t splat);
  bool seen(const driver::Extent& box) const;
  void add(std::uint32_t splat);
  /// Adds the errors of the splat to the layers that it reaches at a pixel.
  void add_pixel(const Touch& touch, std::span<Layer> layers, PixelBound& pixel);
  void finish_sheet(std::size_t sheet);
  void term(Term which, double amount) { terms_[static_cast<std::size_t>(which)] += amount; }

  const stages::Chain& chain_;
  const stages::Mixture& known_;
  const Roundings& r_;
  const KnownSplats& splats_;
  golden::Rows rows_;
  int width_;
  std::size_t sheets_;  ///< 0 if every sample is composited
  LayerBound layers_;
  WeightBound weights_;
  SliceBound slices_;
  std::vector<std::vector<Layer>> of_pixel_;  ///< layers, front to back
  std::vector<std::size_t> next_;             ///< of every sample: a pixel's next layer
  std::vector<PixelBound> pixels_;
  Terms terms_{};
  const Sliced* sliced_ = nullptr;
  std::size_t longest_ = 0;  ///< the most sheets of a splat so far
  std::vector<Sums> shares_;
};

}  // namespace fastsplat::analysis
