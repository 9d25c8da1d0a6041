// SPDX-License-Identifier: Apache-2.0
// The footprints that a frame loads and the one that a splat uses. There is one for each radius, times one for each
// picture of textured splats.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// Radii that differ by no more than this, relatively, count as equal.
inline constexpr double kSameRadius = 1e-9;

/// rho = ceil(r K): the radius (pixels) as a word, in 1/K pixel.
std::uint32_t support_radius(double radius, const cmodel::Config& config);

/// Radii in pixels, in geometric steps between the smallest and the largest that a frame needs; one for orthographic
/// views. They repeat for each picture (scene::TexturedSplats) that a splat may show.
class RadiusSets {
 public:
  /// Throws UserError (Usage) if the largest footprint does not fit the RLUT, or if there are more pictures than
  /// rlut.sets.
  RadiusSets(const cmodel::Config& config, double smallest, double largest, std::size_t pictures = 1);

  std::uint32_t nearest(double radius, std::size_t picture = 0) const;
  std::size_t picture(std::uint32_t set) const { return set / each_; }
  double radius(std::uint32_t set) const { return radii_[set]; }
  std::uint32_t rho(std::uint32_t set) const { return rho_[set]; }        ///< support_radius()
  std::uint32_t base(std::uint32_t set) const { return set * columns_; }  ///< 0 where sets have no columns
  std::size_t size() const { return radii_.size(); }

 private:
  std::vector<double> radii_;
  std::vector<std::uint32_t> rho_;
  std::uint32_t columns_ = 0;  ///< RLUT columns of the largest set, allotted to every set; 0 for kinds without columns
  std::uint32_t each_ = 1;     ///< radii per picture
  double smallest_ = 0.0, bins_per_log_ = 0.0;
};

}  // namespace fastsplat::driver
