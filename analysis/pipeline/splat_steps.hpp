// SPDX-License-Identifier: Apache-2.0
// The steps of a splat before its pixels: position, snap, radius, emission, depth, phi, share.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/pipeline/real_narrowing.hpp"
#include "analysis/pipeline/step.hpp"
#include "base/uninitialised.hpp"
#include "driver/splats/slices.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tables/radius_sets.hpp"
#include "driver/tiles/tile_bins.hpp"
#include "golden/splat/footprint.hpp"
#include "golden/splat/projected_splat.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"
#include "scene/splat_shaper.hpp"
#include "scene/splats.hpp"

namespace fastsplat::stages {

/// A splat of a hybrid pipeline.
struct StagedSplat {
  double x = 0.0, y = 0.0;  ///< centre, image pixels
  double radius = 0.0;      ///< support, pixels
  double z = 0.0;           ///< depth, kernel units: as golden's, or a multiple of 2^-zf behind the first boundary
  golden::Sums value{};     ///< R, G, B, tau of the whole splat
  int first = 0;            ///< nearest sheet that it reaches
};

/// How much deeper a kernel is than its own.
struct Growth {
  double real = 1.0;
  std::uint32_t shrink = 1U << 16;  ///< driver::DepthGrowth's
};

/// Additional data of a splat in a frame with ellipses.
struct StagedShape {
  bool own = false;                     ///< an ellipse; else a circle of a radius set, perhaps grown in depth
  scene::ScreenShape screen;            ///< golden's shape
  double a = 0.0, b = 0.0, c = 0.0;     ///< q = a dx^2 + b dx dy + c dy^2, radial table entries, pixels
  std::array<double, 3> unit{};         ///< the same of u = q / N, 1 at the edge
  double reach_x = 0.0, reach_y = 0.0;  ///< half sides of the box where q < N, pixels
  double beyond = 0.0;                  ///< how far beyond it rounded coefficients may move pixels inside
  cmodel::EllipseShape words;           ///< the device's words, on either side of step radius
  std::int32_t word_x = 0, word_y = 0;  ///< likewise the centre, pf fraction bits
  /// Of a 3-D Gaussian: its windows are those of each tile. Else null.
  const driver::TileGrid* tiles = nullptr;
  Growth growth;
};

/// The coefficients and the box of a footprint's ellipse, as step radius makes them.
void set_ellipse(const cmodel::Config& config, const scene::ScreenShape& footprint, const cmodel::EllipseShape& words,
                 const Mixture& mixture, StagedShape& shape);

/// Of centres in the picture. Centres in a tile are rounded where the tile is known, in step distance.
inline const RoundToFloat& centre_rounding(const Mixture& mixture) {
  static const RoundToFloat exact;
  return mixture.tile_centres() ? exact : mixture.rounding(Step::Position);
}

struct Staged {
  Uninitialised<StagedSplat> splats;
  std::vector<StagedShape> shapes;  ///< one for each splat; empty in a frame of circles
  const StagedShape* shape(std::size_t i) const { return shapes.empty() ? nullptr : &shapes[i]; }
};

/// The voxel whose splat it is.
glm::ivec3 voxel_of(const volume::Volume& volume, const scene::Splat& splat);

/// The pixels within a reach about a place, in `rows` of an image of `width` columns.
inline driver::Extent pixels_about(double x, double y, double reach_x, double reach_y, golden::Rows rows, int width) {
  const auto clip = [](double at, int low, int high) {
    return static_cast<std::int32_t>(std::clamp(at, static_cast<double>(low), static_cast<double>(high)));
  };
  const std::int32_t bottom = clip(std::floor(y + reach_y) + 1.0, rows.first, rows.end);
  return {clip(std::ceil(x - reach_x), 0, width), clip(std::floor(x + reach_x) + 1.0, 0, width),
          clip(std::ceil(y - reach_y), rows.first, rows.end), bottom, bottom};
}

/// The splats of a scene in golden's order within a nearest sheet: traversal order, densities in memory order. Each has
/// the line of voxels on which it lies (scene::Traversal).
struct SplatList {
  SplatList() = default;
  explicit SplatList(const scene::Scene& scene);
  /// These splats of the list, which holds colours.
  SplatList part(std::span<const std::uint32_t> which) const;
  std::vector<scene::Splat> splats;
  std::vector<std::uint32_t> lines;
  int rows = 0, columns = 0;
  // Only for densities:
  std::vector<float> above;              ///< value less the volume's least, which is golden's "extinction"
  std::vector<std::uint32_t> traversed;  ///< indices into `splats` in traversal order

 private:
  void order_densities(const volume::Volume& volume);
};

/// The steps of a frame's splats, on either side. Keeps references to `scene` and `config`.
class SplatSteps {
 public:
  SplatSteps(const scene::Scene& scene, const cmodel::Config& config);

  /// In the order of the list. With `golden_units`, values are golden's: material times density, without the kernel's
  /// peak, which golden's weights contain. Otherwise they are the device's, with the X-ray exposure. Values of
  /// densities are fractions of the volume's range over the slabs' width, in golden's units the volume's own.
  /// The result is in `memory`, that of a frame before.
  Staged staged(const SplatList& list, const Mixture& mixture, bool golden_units, int threads,
                Staged memory = {}) const;

  /// The splat's share in each sheet, from splat.first on.
  void shares(const StagedSplat& splat, const Mixture& mixture, std::vector<golden::Sums>& out,
              const Growth& growth = {}) const;

  bool carries() const { return quantiser_.carries(); }  ///< rounding errors are diffused to the next splat
  int sheets() const { return plan_.slabs.count; }
  int reach(const Mixture& mixture = {}) const;  ///< the most sheets that one splat reaches
  const driver::RadiusSets& sets() const { return sets_; }
  bool shaped() const { return shaper_.has_value(); }  ///< a frame with ellipses

  /// Fraction of the kernel in front of boundary `boundary`: 0 at the first one, 1 at the last.
  double phi(const StagedSplat& splat, int boundary, const Mixture& mixture, const Growth& growth = {}) const;
  /// Distance of boundary `boundary` behind the splat's centre, kernel units.
  double behind(const StagedSplat& splat, int boundary, const Mixture& mixture) const;
  bool sliced() const { return plan_.use == scene::SheetUse::Sliced; }

 private:
  int first_sheet(const scene::RealSplat& splat, double z, const Mixture& mixture, const Growth& growth) const;
  /// Sets centre, radius and value (not yet rounded) of a splat that is a circle.
  void circle(const scene::RealSplat& real, const Mixture& mixture, double unit_value, StagedSplat& splat) const;
  /// The shape of a splat in a frame with ellipses. Changes `splat`, made by circle(), unless step radius is the
  /// device's and it is a circle of the radius set.
  StagedShape shape(const scene::Splat& voxel, const scene::RealSplat& real, const Mixture& mixture, double unit_value,
                    StagedSplat& splat) const;

  const scene::Scene& scene_;
  const cmodel::Config& config_;
  scene::SheetPlan plan_;
  driver::Slices slices_;
  driver::RadiusSets sets_;
  driver::SplatQuantiser quantiser_;
  driver::Target position_, centre_, shrink_, depth_, whole_, phi_word_;
  std::optional<scene::SplatShaper> shaper_;
  RealNarrowing snap_;
  bool xray_;
  double density_;  ///< 1 / (volume's range times slab width)
  double whole_ulp_, largest_share_, depth_ulp_;
  std::vector<double> boundary_;   ///< B_s 2^-zf
  std::vector<double> phi_table_;  ///< PHI 2^-hf
  std::vector<double> phi_real_;   ///< the same entries, unrounded
};

}  // namespace fastsplat::stages
