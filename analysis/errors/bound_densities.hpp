// SPDX-License-Identifier: Apache-2.0
// The bound on a band of image rows whose sheets hold densities (docs/errors.md, section 3, "Densities"): ranges of
// densities become ranges of colours and optical depths, pixel by pixel.
#pragma once

#include <array>
#include <vector>

#include "analysis/errors/bound_layer.hpp"
#include "analysis/errors/bound_slices.hpp"
#include "analysis/errors/bound_weights.hpp"
#include "analysis/pipeline/band_bins.hpp"
#include "analysis/pipeline/density_ranges.hpp"

namespace fastsplat::analysis {

class DensityBoundBand {
 public:
  /// Keeps references. `splats` are binned by the first sheet that each may reach, with DensityBand::kHalo.
  DensityBoundBand(const stages::Chain& chain, const stages::Mixture& known, const stages::Mixture& device,
                   const Roundings& roundings, const KnownSplats& splats, golden::Rows rows, int width);

  void run(const stages::BandBins& bins, int band);
  const std::vector<PixelBound>& pixels() const { return pixels_; }  ///< row by row
  const Terms& terms() const { return terms_; }                      ///< sums over values

 private:
  /// A sheet at a pixel: the known density, and the largest error of the device's by step.
  struct Density {
    double known = 0.0;
    std::array<double, 8> errors{};  ///< Term::Place to Term::Product

    double error() const;
  };
  /// The most that a layer's sums are off.
  struct Off {
    double tau = 0.0;
    std::array<double, 3> spread{};
  };

  std::size_t index(int x, int y, int sheet) const;
  const Density& at(int x, int y, int sheet) const;  ///< none in front of the first sheet and behind the last
  void add(std::uint32_t splat);
  void bound(int x, int y, PixelBound& pixel);
  stages::DensityRange around(int x, int y, int sheet, bool with_errors) const;
  Off off(const stages::ClassifiedRange& range, const Layer& layer) const;
  /// The first-order effect on the pixel behind T = 1.
  double effect(const Layer& layer, const Off& off, std::size_t c) const;
  /// Adds `amount`, an effect of the densities that the pixel's sheet depends on, to the terms.
  void share_out(double amount, int x, int y, int sheet);

  const stages::Chain& chain_;
  const stages::Mixture& known_;
  const Roundings& r_;
  const KnownSplats& splats_;
  golden::Rows rows_, with_halo_;
  int width_, height_, sheets_;
  LayerBound layers_;
  WeightBound weights_;
  SliceBound slices_;
  stages::DensityRanges ranges_;
  std::vector<Density> densities_;  ///< by row of the band and its halo, column, sheet
  std::vector<Layer> of_pixel_;
  std::vector<stages::ClassifiedRange> alone_;     ///< by sheet: as if densities had no error
  std::vector<stages::ClassifiedRange> together_;  ///< by sheet
  std::vector<PixelBound> pixels_;
  Terms terms_{};
};

}  // namespace fastsplat::analysis
