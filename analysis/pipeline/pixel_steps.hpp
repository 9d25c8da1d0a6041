// SPDX-License-Identifier: Apache-2.0
// The steps that composite a finished sheet into a pixel and output the pixel: sheet, factor, slab, composite, freeze,
// pixel.
#pragma once

#include <vector>

#include "analysis/pipeline/real_narrowing.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"

namespace fastsplat::stages {

/// Colour and opacity of a slab at a pixel.
struct RealSlab {
  std::array<double, 3> colour{};
  double opacity = 0.0;
};

class PixelSteps {
 public:
  /// With `golden_units`, an X-ray's exposure is applied here. Sums of classified densities have passed step sheet.
  PixelSteps(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture, bool golden_units);

  /// A pixel before the first sheet: C and T, or an X-ray's sums.
  golden::Sums initial() const { return {0.0, 0.0, 0.0, xray_ ? 0.0 : 1.0}; }
  /// Composites a sheet's sums, or one sample's products, into the pixel. Returns true if nothing behind can change it.
  bool take(const golden::Sums& sums, golden::Sums& pixel) const;
  /// The output R, G, B, A.
  golden::Sums out(const golden::Sums& pixel) const;
  /// (1-exp(-tau))/tau, of the table or real.
  double factor(double tau) const;
  /// The sums, saturated by step sheet.
  golden::Sums cut(const golden::Sums& sums) const;
  /// Of saturated sums.
  RealSlab slab(const golden::Sums& sums) const;

 private:
  bool frozen(double transmittance) const { return transmittance < freeze_below_; }

  bool xray_, additive_;
  bool sheet_, factor_, slab_;
  bool bright_;  ///< real colours of additive slabs may exceed 1: Gaussians
  bool composite_, pixel_;
  RoundToFloat sheet_float_, factor_float_, slab_float_, composite_float_, light_float_, pixel_float_;
  double exposure_, freeze_below_;
  RealNarrowing sum_, fall_, slab_word_, slab_opacity_, added_word_, added_opacity_, light_, absorbed_, over_,
      pixel_out_, pixel_sum_;
  std::vector<double> factors_;
  double segments_per_tau_, last_segment_;
};

}  // namespace fastsplat::stages
