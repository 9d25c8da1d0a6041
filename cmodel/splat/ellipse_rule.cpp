// SPDX-License-Identifier: Apache-2.0
#include "cmodel/splat/ellipse_rule.hpp"

#include <algorithm>
#include <string>

#include "cmodel/splat/ellipse_unit.hpp"

namespace fastsplat::cmodel {
namespace {

ErrorParts wrong(const char* what, std::string expected, std::int64_t got) {
  return {.where = {}, .what = what, .expected = std::move(expected), .got = std::to_string(got), .fix = {}};
}

}  // namespace

std::optional<ErrorParts> ellipse_violation(const Config& config, const EllipseRecord& record) {
  const EllipseShape& shape = record.shape;
  const EllipseWindows& windows = record.windows;
  const std::int64_t product = 4 * std::int64_t{shape.a} * shape.c, square = std::int64_t{shape.b} * shape.b;
  if (product < square)
    return wrong("invalid ellipse: q would be negative somewhere", "4 A C >= B^2 = " + std::to_string(square), product);
  const std::int64_t right = windows.left + std::int64_t{windows.columns} * config.lanes,
                     bottom = windows.top + std::int64_t{windows.rows} * config.lanes;
  if (std::max(right, bottom) > kEllipseReach)
    return wrong("windows reach too far from the centre", "at most " + std::to_string(kEllipseReach) + " pixels",
                 std::max(right, bottom));
  // q is convex, so it is largest at a corner.
  const EllipseAxis x = ellipse_axis(config, record.x, windows.left), y = ellipse_axis(config, record.y, windows.top);
  const std::int64_t pixel = std::int64_t{1} << config.position_frac_bits;
  const std::int64_t far_x = x.distance + (std::int64_t{windows.columns} * config.lanes - 1) * pixel;
  const std::int64_t far_y = y.distance + (std::int64_t{windows.rows} * config.lanes - 1) * pixel;
  const std::int64_t largest = std::max({exact_q(shape, x.distance, y.distance), exact_q(shape, far_x, y.distance),
                                         exact_q(shape, x.distance, far_y), exact_q(shape, far_x, far_y)}) >>
                               shape.shift;
  const std::int64_t most = (config.rlut_rim() * config.lanes * config.lanes) << 8;
  if (largest < most) return std::nullopt;
  return wrong("windows reach too far beyond the footprint: q at a corner",
               "below 256 P^2 N 2^g = " + std::to_string(most), largest);
}

}  // namespace fastsplat::cmodel
