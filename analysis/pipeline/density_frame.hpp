// SPDX-License-Identifier: Apache-2.0
// Draws a band of rows sheet by sheet if sheets hold densities; Chain::Band does so for colours. A pixel reads three
// sheets and its neighbours, so no splat is ever left out of a sheet (docs/numerics.md, section 6.2).
#pragma once

#include <vector>

#include "analysis/pipeline/add_products.hpp"
#include "analysis/pipeline/band_bins.hpp"
#include "analysis/pipeline/density_steps.hpp"
#include "analysis/pipeline/pixel_steps.hpp"
#include "analysis/pipeline/splat_steps.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "golden/sheet.hpp"

namespace fastsplat::stages {

class DensityBand {
 public:
  static constexpr int kHalo = 1;  ///< halo around a band whose densities are read, pixels

  /// Data shared by all bands; DensityBand keeps the references.
  struct Frame {
    const scene::Scene& scene;
    const cmodel::Config& config;
    const SplatSteps& steps;
    const DensitySteps& densities;
    const Mixture& mixture;
    const Staged& splats;
    bool golden_units = false;  ///< units of `splats` and weights
  };
  DensityBand(const Frame& frame, golden::Rows rows);

  /// `bins`: splats that reach the band or its halo.
  void run(const BandBins& bins, int band);
  /// R, G, B, A of the band's pixels, row by row.
  void store(golden::Sums* out) const;

 private:
  golden::Sheet& at(int sheet) { return ring_[static_cast<std::size_t>(sheet) % ring_.size()]; }
  void add(const StagedSplat& splat, const StagedShape* shape);
  /// Step sheet, once the sheet has all its splats.
  void end(golden::Sheet& sheet) const;
  void classify(const golden::SheetWindow& window);
  DensityPixel pixel_of(const golden::SheetWindow& window, int x, int y) const;

  Frame frame_;
  golden::Rows rows_, with_halo_;
  int width_, height_;
  bool all_real_, cut_;
  RealNarrowing sum_;
  WeightSteps weights_;
  PixelSteps pixels_;
  ProductRule product_;
  std::vector<golden::Sheet> ring_;
  golden::Sheet nothing_;
  std::vector<golden::Sums> picture_, shares_, material_;
  std::vector<char> settled_;  ///< pixels that cannot change any more
  std::size_t open_;           ///< number of the others
};

}  // namespace fastsplat::stages
