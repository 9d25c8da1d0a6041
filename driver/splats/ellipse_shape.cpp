// SPDX-License-Identifier: Apache-2.0
#include "driver/splats/ellipse_shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "driver/splats/ellipse_rim.hpp"
#include "driver/tables/quantise.hpp"

namespace fastsplat::driver {
namespace {

/// The pixels strictly between two positions: [first, end).
struct PixelRange {
  std::int32_t first = 0, end = 0;
};
PixelRange between(double from, double to) {
  return {static_cast<std::int32_t>(std::floor(from)) + 1, static_cast<std::int32_t>(std::ceil(to))};
}

}  // namespace

scene::ScreenShape drawn_footprint(const scene::ScreenShape& shape, double kernel_radius) {
  const double square = kernel_radius * kernel_radius;
  scene::ScreenShape out{square * shape.xx, square * shape.xy, square * shape.yy};
  // Eigenvalues of the matrix; the lesser one is raised along its own axis.
  const double middle = 0.5 * (out.xx + out.yy), apart = std::hypot(0.5 * (out.xx - out.yy), out.xy);
  const double least = middle - apart, wanted = kThinnest * kThinnest;
  if (least >= wanted) return out;
  if (middle + apart <= wanted || apart == 0.0) return {wanted, 0.0, wanted};
  // out = least I + 2 apart n n^T with n along the longer axis: keeps the extent along n, raises the one across to
  // `wanted`.
  const double keep = (middle + apart - wanted) / (2.0 * apart);
  return {wanted + keep * (out.xx - least), keep * out.xy, wanted + keep * (out.yy - least)};
}

cmodel::EllipseShape ellipse_words(const cmodel::Config& config, const scene::ScreenShape& footprint) {
  // Avoids rounding ties: a kernel grown to one pixel a voxel lies on one, and the last bit would decide (N-8-29).
  constexpr double kAside = 1.0 - 0x1p-40;
  const double rim = kAside * static_cast<double>(config.rlut_rim());
  const double scale = std::ldexp(rim, -2 * config.position_frac_bits);  // per square of 2^-pf pixel
  const double a = scale / (footprint.xx - footprint.xy * (footprint.xy / footprint.yy));
  const double c = scale / (footprint.yy - footprint.xy * (footprint.xy / footprint.xx));
  const double b = -2.0 * (a * (footprint.xy / footprint.yy));
  const Target term = target(Site::EllipseTerm, config), cross = target(Site::EllipseCross, config);
  // Moves the leading bit of the larger of A and C to the word's top bit, unless rounding up would overflow the word.
  int h = std::clamp(cmodel::kEllipseTermBits - 1 - std::ilogb(std::max(a, c)), 0, cmodel::kEllipseMostShift);
  if (h > 0 && std::ceil(std::ldexp(std::max(a, c), h)) > term.to.max) --h;
  cmodel::EllipseShape out{.a = quantise_to<std::uint32_t>(std::ldexp(a, h), term),
                           .c = quantise_to<std::uint32_t>(std::ldexp(c, h), term),
                           .b = 0,
                           .shift = static_cast<std::uint32_t>(h)};
  const double most = std::floor(2.0 * std::sqrt(static_cast<double>(out.a) * static_cast<double>(out.c)));
  const auto size =
      std::min(quantise_to<std::int32_t>(std::ldexp(std::abs(b), h), cross), static_cast<std::int32_t>(most));
  out.b = b < 0.0 ? -size : size;
  return out;
}

double determinant_error(const cmodel::Config& config, const cmodel::EllipseShape& words,
                         const scene::ScreenShape& footprint) {
  const double scale = std::ldexp(rim_of(config, words), -2 * config.position_frac_bits);
  return determinant(words) * footprint.determinant() / (4.0 * scale * scale) - 1.0;
}

EllipseReach reach(const cmodel::Config& config, const cmodel::EllipseShape& shape) {
  const double rim = rim_of(config, shape), det = determinant(shape);
  const double pixel = std::ldexp(1.0, -config.position_frac_bits);
  return {std::sqrt(4.0 * shape.c * rim / det) * pixel, std::sqrt(4.0 * shape.a * rim / det) * pixel};
}

EllipseSpans::EllipseSpans(const cmodel::Config& config, const cmodel::EllipseShape& shape, std::int32_t x,
                           std::int32_t y) {
  const Rim rim(config, shape);
  const std::int32_t mask = (1 << config.position_frac_bits) - 1, lanes = config.lanes;
  const double pixel = mask + 1.0, at_x = x & mask, at_y = y & mask, height = rim.half_height();
  const PixelRange rows = between((at_y - height) / pixel, (at_y + height) / pixel);
  for (std::int32_t top = rows.first; top < rows.end; top += lanes) {
    const std::int32_t bottom = std::min(top + lanes, rows.end);
    const double from = std::max(top * pixel - at_y, -height), to = std::min((bottom - 1) * pixel - at_y, height);
    const PixelRange columns = between((at_x + rim.left(from, to)) / pixel, (at_x + rim.right(from, to)) / pixel);
    if (columns.first >= columns.end) continue;
    const auto across = static_cast<std::uint32_t>((columns.end - columns.first + lanes - 1) / lanes);
    EllipseSpan* last = count_ > 0 ? &spans_[count_ - 1] : nullptr;
    const auto end_of = [&](const EllipseSpan& span) {
      return span.windows.top + static_cast<std::int32_t>(span.windows.rows) * lanes;
    };
    if (last != nullptr && last->windows.left == columns.first && last->windows.columns == across &&
        end_of(*last) == top) {
      ++last->windows.rows;
      last->right = std::max(last->right, columns.end);
      last->bottom = bottom;
      continue;
    }
    assert(count_ < spans_.size());
    spans_[count_++] = {.windows = {.left = columns.first, .top = top, .columns = across, .rows = 1},
                        .right = columns.end,
                        .bottom = bottom};
  }
}

}  // namespace fastsplat::driver
