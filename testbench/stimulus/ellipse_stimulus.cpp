// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/ellipse_stimulus.hpp"

#include <algorithm>
#include <bit>

#include "cmodel/splat/ellipse_rule.hpp"

namespace fastsplat::testbench {
namespace {

/// The largest b with b^2 <= square.
std::int64_t root(std::int64_t square) {
  std::int64_t b = 0;
  for (std::int64_t bit = std::int64_t{1} << 23; bit > 0; bit /= 2)
    if ((b + bit) * (b + bit) <= square) b += bit;
  return b;
}

/// One term is large, the other smaller by the ratio of the axes.
cmodel::EllipseShape shape(const cmodel::Config& config, Random& random) {
  cmodel::EllipseShape out;
  const std::int64_t most = (std::int64_t{1} << cmodel::kEllipseTermBits) - 1;
  const std::int64_t large = random.chance(5) ? most : random.between(most / 2, most);
  const std::int64_t other = random.chance(30) ? large : random.between(0, large) >> random.between(0, 8);
  const bool steep = random.chance(50);
  out.a = static_cast<std::uint32_t>(steep ? large : other);
  out.c = static_cast<std::uint32_t>(steep ? other : large);
  const std::int64_t widest = root(4 * std::int64_t{out.a} * out.c);
  const std::int64_t b = random.chance(10) ? widest : random.chance(30) ? 0 : random.between(0, widest);
  out.b = static_cast<std::int32_t>(random.chance(50) ? b : -b);
  // The short half axis: 2^(halves/2) pixels, 1/4 to some windows.
  const int halves = static_cast<int>(random.between(-4, 4 + 2 * cmodel::Config::log2_exact(config.lanes)));
  const int rim = config.radial_index_bits() + config.rlut_guard_bits;
  const int h = cmodel::kEllipseTermBits - rim + 2 * config.position_frac_bits + halves;
  out.shift = static_cast<std::uint32_t>(std::clamp(h, 0, cmodel::kEllipseMostShift));
  return out;
}

}  // namespace

cmodel::EllipseRecord random_ellipse(const cmodel::Config& config, Random& random, std::int32_t x, std::int32_t y,
                                     std::int64_t most) {
  cmodel::EllipseRecord out{.tag = 0, .x = x, .y = y, .colour = {}, .shape = shape(config, random), .windows = {}};
  cmodel::EllipseWindows& windows = out.windows;
  const std::int64_t lanes = config.lanes, room = cmodel::kEllipseReach / lanes;
  const auto side = [&] {
    if (random.chance(3)) most = std::min<std::int64_t>(cmodel::kEllipseWindows, room);
    return static_cast<std::uint32_t>(random.between(1, std::min<std::int64_t>(most, cmodel::kEllipseWindows)));
  };
  windows.columns = side();
  windows.rows = random.chance(60) ? std::min<std::uint32_t>(side(), 3) : side();
  const auto corner = [&](std::uint32_t count) {
    const std::int64_t wide = count * lanes;
    if (random.chance(3)) return static_cast<std::int32_t>(random.between(-512, cmodel::kEllipseReach - wide));
    return static_cast<std::int32_t>(-wide / 2 + random.between(-lanes / 2, lanes / 2));
  };
  windows.left = std::max(corner(windows.columns), -512);
  windows.top = std::max(corner(windows.rows), -512);
  // Until the rule holds: move nearer, use fewer windows, then flatten.
  while (cmodel::ellipse_violation(config, out)) {
    if (windows.left < -lanes || windows.left > 0 || windows.top < -lanes || windows.top > 0) {
      windows.left = static_cast<std::int32_t>(std::clamp<std::int64_t>(windows.left / 2, -lanes * windows.columns, 0));
      windows.top = static_cast<std::int32_t>(std::clamp<std::int64_t>(windows.top / 2, -lanes * windows.rows, 0));
    }
    windows.columns = std::max(windows.columns / 2, 1U);
    windows.rows = std::max(windows.rows / 2, 1U);
    if (windows.columns == 1 && windows.rows == 1)
      out.shape.shift = std::min<std::uint32_t>(out.shape.shift + 1, cmodel::kEllipseMostShift);
  }
  return out;
}

}  // namespace fastsplat::testbench
