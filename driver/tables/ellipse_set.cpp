// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/ellipse_set.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "cmodel/numbers/index_set.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/radius_sets.hpp"

namespace fastsplat::driver {

cmodel::LoadTable ellipse_table(const cmodel::Config& config, std::uint32_t set, const EllipseRim& rim) {
  assert(config.index() == cmodel::IndexKind::SquaredElliptic);
  const double entries = config.radial_entries, grid = config.grid();
  // S^-1, in radial table entries per square of 1/K pixel. Divided such that, without xy, only the roundings of a
  // circle's scale remain.
  const double a = entries / ((rim.xx - rim.xy * (rim.xy / rim.yy)) * (grid * grid));
  const double c = entries / ((rim.yy - rim.xy * (rim.xy / rim.xx)) * (grid * grid));
  const double b = -2.0 * (a * (rim.xy / rim.yy));
  const int h = std::clamp(23 - std::ilogb(std::max(a, c)), 0, static_cast<int>(cmodel::kLargestShift));

  const Target scale = target(Site::Scale, config), cross = target(Site::Cross, config);
  const auto size = quantise_to<std::uint32_t>(std::ldexp(std::abs(b), h), cross);
  cmodel::LoadTable table{
      .table = cmodel::Table::Rlut,
      .radius = {.set = set, .rho = support_radius(std::sqrt(std::max(rim.xx, rim.yy)), config), .base = 0},
      .words = {quantise_to<std::uint32_t>(std::ldexp(a, h), scale), b < 0.0 ? 0 - size : size,
                quantise_to<std::uint32_t>(std::ldexp(c, h), scale), static_cast<std::uint32_t>(h)}};
  assert(!cmodel::set_violation(config, table.words));
  return table;
}

}  // namespace fastsplat::driver
