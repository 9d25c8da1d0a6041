// SPDX-License-Identifier: Apache-2.0
// Ellipse records of a shaped splat, from docs/numerics.md, section 8, "Ellipses", alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/driver/oracle/given.hpp"

namespace fastsplat::scene_oracle {

/// Windows of one record, and the pixels that made them: all relative to the pixel that holds the centre.
struct Span {
  std::int64_t left = 0, top = 0, nx = 0, ny = 0;
  std::int64_t last_column = 0, last_row = 0;  ///< that the footprint has
};

struct EllipseWords {
  std::int64_t A = 0, B = 0, C = 0;
  int h = 0;
  std::vector<Span> spans;
  bool thin = false;       ///< it has grown across
  double factor = 1.0;     ///< of the reals, for that
  bool too_large = false;  ///< a half side beyond half of rlut.columns
};

/// Whether every splat of the frame has a shape.
bool shaped(const Given& given);

/// A circle of the frame's only radius set is a splat record.
bool is_circle_of(const Given& given, const Shape& shape, double r_max);

/// For the footprint R^2 S around a centre (x, y), in words of the image.
EllipseWords ellipse_words(const Given& given, const Shape& shape, std::int64_t x, std::int64_t y);

}  // namespace fastsplat::scene_oracle
