// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/radius_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "driver/tables/quantise.hpp"

namespace fastsplat::driver {

std::uint32_t support_radius(double radius, const cmodel::Config& config) {
  return quantise_to<std::uint32_t>(radius, target(Site::Rho, config));
}

RadiusSets::RadiusSets(const cmodel::Config& config, double smallest, double largest, std::size_t pictures)
    : smallest_(smallest) {
  if (pictures > static_cast<std::size_t>(config.rlut_sets)) {
    throw_usage({.where = "splat_texture.phases",
                 .what = "each phase of a textured splat needs its own radius set",
                 .expected = fmt::format("at most rlut.sets = {}", config.rlut_sets),
                 .got = fmt::format("{}", pictures),
                 .fix = "use fewer --splat-phases, or a larger rlut.sets"});
  }
  // The largest radius on the 1/K grid whose columns fit. It is less than half the RLUT only if that half is off the
  // grid.
  const double widest =
      std::ldexp(std::floor(std::ldexp(config.rlut_columns, config.grid_bits() - 1)), -config.grid_bits());
  if (!(largest <= widest)) {
    throw_usage(
        {.where = "configuration " + config.name,
         .what = "the kernel's footprint is wider than the RLUT",
         .expected = fmt::format("a radius of at most {} pixels (rlut.columns = {})", widest, config.rlut_columns),
         .got = fmt::format("{:.2f} pixels", largest),
         .fix = "use a smaller --size or --zoom, or a configuration with more rlut.columns"});
  }
  const std::uint32_t widest_set = cmodel::window_geometry(config, support_radius(largest, config)).padded;
  columns_ = config.has_columns() ? widest_set : 0;
  const auto most = static_cast<std::uint32_t>(static_cast<std::size_t>(config.rlut_sets) / pictures);
  const std::uint32_t room = config.has_phases() ? static_cast<std::uint32_t>(config.rlut_columns) / widest_set : most;
  const bool one_radius = largest <= smallest * (1.0 + kSameRadius);
  const std::uint32_t count = each_ = one_radius ? 1 : std::min(room, most);
  if (one_radius) {
    radii_ = {largest};
  } else {
    bins_per_log_ = count / std::log(largest / smallest);
    for (std::uint32_t set = 0; set < count; ++set) radii_.push_back(smallest * std::exp((set + 0.5) / bins_per_log_));
  }
  for (std::size_t picture = 1; picture < pictures; ++picture)
    for (std::uint32_t set = 0; set < each_; ++set) radii_.push_back(radii_[set]);
  for (const double radius : radii_) rho_.push_back(support_radius(radius, config));
}

std::uint32_t RadiusSets::nearest(double radius, std::size_t picture) const {
  const std::uint32_t first = static_cast<std::uint32_t>(picture) * each_;
  if (each_ == 1) return first;
  const double bin = std::floor(std::log(radius / smallest_) * bins_per_log_);
  return first + static_cast<std::uint32_t>(std::clamp(bin, 0.0, static_cast<double>(each_ - 1)));
}

}  // namespace fastsplat::driver
