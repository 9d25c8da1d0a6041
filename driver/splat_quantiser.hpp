// A real splat as the device's numbers (docs/numerics.md, section 8), not yet cut into slabs or tiles.
#pragma once

#include <cstdint>

#include "cmodel/config.hpp"
#include "driver/quantise.hpp"
#include "driver/radius_sets.hpp"
#include "driver/slices.hpp"
#include "scene/real_splat.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// r = (R u) s: a splat's support radius in pixels where a mm is `pixels_per_mm` pixels.
inline double pixel_radius(const scene::Scene& scene, double pixels_per_mm) {
  return scene.kernel.radius() * scene.volume->kernel_unit() * pixels_per_mm;
}

/// 32 bytes a voxel: what a frame keeps in memory.
struct QuantisedSplat {
  std::int32_t x = 0, y = 0;  ///< image pixels, pf fraction bits
  std::int32_t depth = 0;     ///< Slices::quantise_depth, or the sheet number where splats are not sliced
  std::uint32_t set = 0;      ///< radius set
  SplatWords words{};         ///< whole splat, U 4.cf; all 0: it vanished
};

class SplatQuantiser {
 public:
  /// Keeps references to `scene`, `sets` and `slices`.
  SplatQuantiser(const scene::Scene& scene, const cmodel::Config& config, const RadiusSets& sets, const Slices& slices,
                 const scene::SheetPlan& plan);

  /// `saturated` is set when a channel left U 4.cf, and left alone otherwise.
  QuantisedSplat operator()(const scene::RealSplat& splat, bool& saturated) const;

 private:
  std::int32_t depth(const scene::RealSplat& splat) const;

  const scene::Scene& scene_;
  const RadiusSets& sets_;
  const Slices& slices_;
  scene::SheetPlan plan_;
  Target position_, whole_;
  double exposed_;  ///< amplitude times exposure
};

}  // namespace fastsplat::driver
