// A real splat as the device's numbers (docs/numerics.md, section 8), not yet cut into slabs or tiles.
#pragma once

#include <cstdint>
#include <optional>

#include "cmodel/config.hpp"
#include "driver/quantise.hpp"
#include "driver/radius_sets.hpp"
#include "driver/rounding_carry.hpp"
#include "driver/slices.hpp"
#include "scene/real_splat.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// r = (R u) s: a splat's support radius in pixels where a mm is `pixels_per_mm` pixels.
inline double pixel_radius(const scene::Scene& scene, double pixels_per_mm) {
  return scene.kernel.radius() * scene.volume->kernel_unit() * pixels_per_mm;
}

/// Whether what rounding takes of a splat goes to the next one behind it (rounding.carry).
bool carries(scene::Method method, const cmodel::Config& config);

/// 32 bytes a voxel, never in two lines of a cache: what a frame keeps in memory.
struct alignas(32) QuantisedSplat {
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

  struct Result {
    QuantisedSplat splat;
    bool saturated = false;  ///< a channel left U 4.cf
    double asked = 0.0;      ///< sum of the four channels before rounding
  };
  Result operator()(const scene::RealSplat& splat) const {
    return quantised(splat, [this](double value, std::size_t) { return quantise(value, whole_); });
  }
  /// `line`: of the grid (scene::Traversal). The splats of a line come front to back.
  Result operator()(const scene::RealSplat& splat, std::uint32_t line, RoundingCarry& carry) const {
    return quantised(splat, [&](double value, std::size_t channel) { return carry(value, line, channel); });
  }
  /// Whether roundings are carried on: then no splat is lost by being too thin.
  bool carries() const { return carries_; }
  RoundingCarry carry(int first_row, int end_row, int columns) const {
    return {carried_, *shown_, first_row, end_row, columns};
  }

 private:
  std::int32_t depth(const scene::RealSplat& splat) const;
  template <class Round>
  Result quantised(const scene::RealSplat& splat, const Round& round) const {
    const double radius = pixel_radius(scene_, splat.at.scale);
    Result out{.splat = {.x = quantise_to<std::int32_t>(splat.at.x, position_),
                         .y = quantise_to<std::int32_t>(splat.at.y, position_),
                         .depth = depth(splat),
                         .set = sets_.nearest(radius),
                         .words = {}}};
    // The set's footprint is a little wider or narrower than the splat's own: as much is added in all.
    const double width_ratio = radius / sets_.radius(out.splat.set);
    const double amplitude = exposed_ * width_ratio * width_ratio;
    for (std::size_t c = 0; c < 4; ++c) {
      const double value = splat.material[c] * amplitude;
      const Quantised channel = round(value, c);
      out.saturated = out.saturated || channel.saturated;
      out.splat.words[c] = static_cast<std::uint32_t>(channel.word);
      out.asked += value;
    }
    return out;
  }

  const scene::Scene& scene_;
  const RadiusSets& sets_;
  const Slices& slices_;
  scene::SheetPlan plan_;
  Target position_, whole_, carried_;
  bool carries_;
  std::optional<ShownWords> shown_;  ///< where roundings are carried
  double exposed_;                   ///< amplitude times exposure
};

}  // namespace fastsplat::driver
