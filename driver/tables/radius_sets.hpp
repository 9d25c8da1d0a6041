// Which footprints a frame loads, and which one a splat uses: of some radii, and of textured splats each with several
// pictures.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// Radii that differ by no more than this, relatively, are one.
inline constexpr double kSameRadius = 1e-9;

/// rho = ceil(r K): the radius in pixels as the device takes it, 1/K pixel.
std::uint32_t support_radius(double radius, const cmodel::Config& config);

/// Radii in pixels, geometric between the smallest and the largest a frame needs; one for orthographic views. All of
/// them again for each picture (scene::TexturedSplats) that a splat may show.
class RadiusSets {
 public:
  /// Throws UserError (Usage) when the largest footprint does not fit the RLUT, or the pictures are more than sets.
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
  std::uint32_t columns_ = 0;  ///< RLUT columns of the largest set, as many as every set gets; or none
  std::uint32_t each_ = 1;     ///< radii, of each picture
  double smallest_ = 0.0, bins_per_log_ = 0.0;
};

}  // namespace fastsplat::driver
