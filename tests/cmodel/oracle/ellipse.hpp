// SPDX-License-Identifier: Apache-2.0
// Ellipse records by docs/numerics.md, section 4.6, and rule 18 of docs/stream.md: wide integers, the quadratic form as
// it is written, every pixel by itself.
#pragma once

#include <cstdint>

#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::oracle {

struct Ellipse {
  std::uint32_t tag = 0;
  std::int32_t x = 0, y = 0;
  std::uint32_t v[4] = {};
  std::int64_t A = 0, B = 0, C = 0;
  int h = 0;
  int left = 0, top = 0;  ///< pixels from the centre's to the first
  int nx = 1, ny = 1;     ///< windows
};

/// The first pixel, relative to the tile, and its offset from the centre in 2^-pf pixel.
struct FirstPixel {
  Wide x0, y0, X, Y;
};
FirstPixel first_pixel(const Symbols& c, const Ellipse& e);

/// The part of rule 18 that is broken, or nullptr.
const char* broken_shape(const Symbols& c, const Ellipse& e);

/// q of the pixels of one record.
class EllipseForm {
 public:
  EllipseForm(const Symbols& c, const Ellipse& e);
  /// For pixel (i, j) from the first one, in steps of 2^-g radial table entries: at least 0, possibly beyond the last
  /// one.
  Wide steps(std::int64_t i, std::int64_t j) const;
  /// A coefficient left its word; q does not, if rule 18 holds.
  bool wrapped() const { return wrapped_; }

 private:
  Words words;
  Wide step;  ///< 2^-g radial table entries, in q's words
  Wide u0, u1, u2, v1, v2, e;
  bool wrapped_ = false;
};

}  // namespace fastsplat::oracle
