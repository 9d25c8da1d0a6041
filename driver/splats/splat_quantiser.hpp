// SPDX-License-Identifier: Apache-2.0
// Quantises real splats to the device's words (docs/numerics.md, section 8), before they are cut into slabs and tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cmodel/numbers/config.hpp"
#include "driver/splats/ellipse_shape.hpp"
#include "driver/splats/rounding_carry.hpp"
#include "driver/splats/slices.hpp"
#include "driver/splats/splat_kernel.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/radius_sets.hpp"
#include "scene/real_splat.hpp"
#include "scene/sheet_plan.hpp"
#include "scene/splat_shaper.hpp"
#include "scene/textured_splats.hpp"

namespace fastsplat::driver {

/// r = (R u) s: a splat's support radius in pixels at a scale of `pixels_per_mm`.
inline double pixel_radius(const scene::Scene& scene, double pixels_per_mm) {
  return scene.kernel.radius() * scene.volume->kernel_unit() * pixels_per_mm;
}

/// Whether rounding errors are diffused to the next splat behind (rounding.carry).
bool carries(scene::Method method, const cmodel::Config& config);

/// Whether splats have individual shapes, which only a device with ellipses draws. Otherwise all are circles of a
/// radius set.
bool draws_ellipses(const scene::Scene& scene, const cmodel::Config& config);

/// A splat as a frame keeps it in memory: 32 bytes, never across two cache lines.
struct alignas(32) QuantisedSplat {
  std::int32_t x = 0, y = 0;  ///< image pixels, pf fraction bits
  std::int32_t depth = 0;     ///< Slices::quantise_depth, or the sheet number where splats are not sliced
  std::uint32_t set = 0;      ///< radius set, or kOwnShape
  SplatWords words{};         ///< whole splat, U 4.cf; all 0: it vanished
};
inline constexpr std::uint32_t kOwnShape = ~std::uint32_t{0};

/// Additional data of a splat in a frame with ellipses.
struct SplatEllipse {
  cmodel::EllipseShape shape;  ///< shape of a splat with kOwnShape
  std::uint32_t shrink = 0;    ///< DepthGrowth::shrink
};

class SplatQuantiser {
 public:
  /// Keeps references to all arguments but `plan`. `textures` holds the pictures of the sets; null: none.
  SplatQuantiser(const scene::Scene& scene, const cmodel::Config& config, const RadiusSets& sets, const Slices& slices,
                 const scene::SheetPlan& plan, const scene::TexturedSplats* textures = nullptr);

  struct Result {
    QuantisedSplat splat;
    bool saturated = false;  ///< a channel left U 4.cf
    double asked = 0.0;      ///< sum of the four channels before rounding
  };
  /// A splat that is a circle of a radius set, without colour.
  struct Placed {
    QuantisedSplat splat;
    double amplitude = 0.0;  ///< factor on its material
  };
  Placed place(const scene::ScreenPoint& at, int sheet, const glm::vec3& position) const {
    return sized({.x = quantise_to<std::int32_t>(at.x, position_),
                  .y = quantise_to<std::int32_t>(at.y, position_),
                  .depth = depth(at.depth / scene_.volume->kernel_unit(), sheet),
                  .set = 0,
                  .words = {}},
                 at.scale, position);
  }
  /// How place() projects and rounds.
  CentreRule centre_rule() const;
  /// place() of a centre that place_centres() has placed: `depth` is its word where splats are sliced.
  Placed placed(std::int32_t x, std::int32_t y, std::int32_t depth, double scale, int sheet,
                const glm::vec3& position) const {
    return sized({.x = x, .y = y, .depth = sliced() ? depth : this->depth(0.0, sheet), .set = 0, .words = {}}, scale,
                 position);
  }
  /// round_colours() with the format of a splat's words.
  void colour(ColourToRound* colours, std::size_t count) const {
    round_colours(whole_.scale, static_cast<double>(whole_.to.max), colours, count);
  }
  Result operator()(const scene::RealSplat& splat) const {
    return quantised(splat, [this](double value, std::size_t) { return quantise(value, whole_); });
  }
  Result operator()(const scene::RealSplat& splat, const RoundingCarry& carry, RoundingCarry::Line& line) const {
    return quantised(splat, [&](double value, std::size_t channel) { return carry(value, line, channel); });
  }
  /// The same for splats with individual shapes. A circle of the radius set gets the result above.
  struct Shaped {
    Result result;
    SplatEllipse ellipse;
    EllipseReach reach;    ///< pixels; 0 for a circle of the set
    bool widened = false;  ///< it was thinner than kThinnest
  };
  Shaped shaped(const scene::Splat& splat, std::uint32_t line, RoundingCarry* carry) const;
  /// Quantises a row of the grid in order and calls take(Result, sheet), or take(Shaped, sheet) if splats have
  /// individual shapes. `lines`: their lines in the grid (scene::Traversal); Splat::sheet: their slice. `carry`: null
  /// unless carries().
  template <class Take>
  void row(std::span<const scene::Splat> splats, std::span<const std::uint32_t> lines, RoundingCarry* carry,
           Take take) const {
    for (std::size_t i = 0; i < splats.size(); ++i) {
      if (shaper_)
        take(shaped(splats[i], lines[i], carry), splats[i].sheet);
      else if (carry != nullptr)
        take((*this)(scene::real_splat(scene_, splats[i]), *carry, carry->next(lines[i], splats[i].sheet)),
             splats[i].sheet);
      else
        take((*this)(scene::real_splat(scene_, splats[i])), splats[i].sheet);
    }
  }
  const cmodel::Config& config() const { return config_; }
  /// Whether rounding errors are diffused. If so, no splat is lost by being too thin.
  bool carries() const { return carries_; }
  RoundingCarry carry(int first_row, int end_row, int columns) const {
    return {carried_, *shown_, first_row, end_row, columns};
  }

 private:
  bool sliced() const { return plan_.use == scene::SheetUse::Sliced; }
  /// `depth` in kernel units; `sheet`: of the grid.
  std::int32_t depth(double depth, int sheet) const;
  Placed sized(const QuantisedSplat& centre, double scale, const glm::vec3& position) const {
    const double radius = pixel_radius(scene_, scale);
    Placed out{.splat = centre};
    out.splat.set = sets_.nearest(radius, textures_ == nullptr ? 0 : textures_->number_of(position));
    // The set's footprint is a little wider or narrower than the splat's: scaled so that total energy is preserved.
    const double width_ratio = radius / sets_.radius(out.splat.set);
    out.amplitude = exposed_ * width_ratio * width_ratio;
    return out;
  }
  template <class Round>
  void colour(const std::array<double, 4>& values, const Round& round, Result& out) const {
    for (std::size_t c = 0; c < 4; ++c) {
      const Quantised channel = round(values[c], c);
      out.saturated = out.saturated || channel.saturated;
      out.splat.words[c] = static_cast<std::uint32_t>(channel.word);
      out.asked += values[c];
    }
  }
  template <class Round>
  Result quantised(const scene::RealSplat& splat, const Round& round) const {
    return coloured(place(splat.at, splat.sheet, splat.place), splat.material, round);
  }
  template <class Round>
  Result coloured(const Placed& placed, const std::array<double, 4>& material, const Round& round) const {
    Result out{.splat = placed.splat};
    std::array<double, 4> values{};
    for (std::size_t c = 0; c < 4; ++c) values[c] = material[c] * placed.amplitude;
    colour(values, round, out);
    return out;
  }

  const scene::Scene& scene_;
  const RadiusSets& sets_;
  const scene::TexturedSplats* textures_;  ///< null: none
  const Slices& slices_;
  scene::SheetPlan plan_;
  const cmodel::Config& config_;
  Target position_, centre_, whole_, carried_, shrink_;
  std::optional<scene::SplatShaper> shaper_;  ///< only in a frame with ellipses
  bool carries_;
  std::optional<ShownWords> shown_;  ///< only with error diffusion
  double exposed_;                   ///< amplitude times exposure
};

}  // namespace fastsplat::driver
