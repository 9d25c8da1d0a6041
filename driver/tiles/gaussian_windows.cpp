// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/gaussian_windows.hpp"

#include <algorithm>
#include <cmath>

#include "driver/splats/ellipse_rim.hpp"

namespace fastsplat::driver {
namespace {

/// Pixels [first, end), relative to the pixel of the centre.
struct WindowPixels {
  std::int32_t first = 0, end = 0;
};

/// The pixels of `within` strictly between two positions, which may be arbitrarily far away.
WindowPixels between(double from, double to, const WindowPixels& within) {
  const double least = within.first, most = within.end;
  return {static_cast<std::int32_t>(std::clamp(std::floor(from) + 1.0, least, most)),
          static_cast<std::int32_t>(std::clamp(std::ceil(to), least, most))};
}

/// The pixels within reach in a tile that begins `centre` pixels before the centre and is `size` pixels long.
WindowPixels visible(std::int32_t centre, int size, std::int32_t reach) {
  const std::int32_t first = std::clamp(-centre, -reach, reach);
  return {first, std::clamp(size - centre, first, reach)};
}

}  // namespace

int gaussian_reach(const cmodel::Config& config) {
  // A record's windows, padded ones too, end within kEllipseReach. The centre fits S pi.pf relative to every tile
  // within its reach (N-8-64).
  const int positions = (1 << (config.position_int_bits - 1)) - 1 - std::max(config.tile_width, config.tile_height);
  return std::min(cmodel::kEllipseReach - config.lanes, positions);
}

std::vector<cmodel::EllipseWindows> gaussian_windows(const cmodel::Config& config, const cmodel::EllipseShape& shape,
                                                     std::int32_t x, std::int32_t y, int width, int height) {
  const Rim rim(config, shape);
  const int pf = config.position_frac_bits, lanes = config.lanes, reach = gaussian_reach(config);
  const std::int32_t mask = (1 << pf) - 1;
  const double pixel = mask + 1.0, at_x = x & mask, at_y = y & mask, half = rim.half_height();
  const WindowPixels across = visible(x >> pf, width, reach), down = visible(y >> pf, height, reach);
  const WindowPixels rows = between((at_y - half) / pixel, (at_y + half) / pixel, down);
  const std::int32_t longest = cmodel::kEllipseWindows * lanes;
  std::vector<cmodel::EllipseWindows> out;
  for (std::int32_t top = rows.first; top < rows.end; top += lanes) {
    const std::int32_t bottom = std::min(top + lanes, rows.end);
    const double from = std::max(top * pixel - at_y, -half), to = std::min((bottom - 1) * pixel - at_y, half);
    const WindowPixels columns =
        between((at_x + rim.left(from, to)) / pixel, (at_x + rim.right(from, to)) / pixel, across);
    for (std::int32_t left = columns.first; left < columns.end; left += longest) {
      const std::int32_t long_as = std::min(columns.end - left, longest);
      const auto windows = static_cast<std::uint32_t>((long_as + lanes - 1) / lanes);
      cmodel::EllipseWindows* const last = out.empty() ? nullptr : &out.back();
      if (last != nullptr && last->left == left && last->columns == windows &&
          last->rows < static_cast<std::uint32_t>(cmodel::kEllipseWindows) &&
          last->top + static_cast<std::int32_t>(last->rows) * lanes == top) {
        ++last->rows;
      } else {
        out.push_back({.left = left, .top = top, .columns = windows, .rows = 1});
      }
    }
  }
  return out;
}

}  // namespace fastsplat::driver
