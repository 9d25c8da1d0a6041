// SPDX-License-Identifier: Apache-2.0
// A splat's shape on the screen as an ellipse's words, and the windows that cover it (docs/numerics.md, section 8).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "scene/shaped_splat.hpp"

namespace fastsplat::driver {

/// Half the width of the thinnest footprint, pixels. Thinner ones are drawn this wide and fainter by the same factor.
inline constexpr double kThinnest = 0.25;

/// The footprint of a shape: d^T F^-1 d < 1, F = R^2 S. Shapes thinner than kThinnest are widened across (N-8-26).
scene::ScreenShape drawn_footprint(const scene::ScreenShape& shape, double kernel_radius);

/// The words of a footprint; 4 A C >= B^2 after any rounding.
cmodel::EllipseShape ellipse_words(const cmodel::Config& config, const scene::ScreenShape& footprint);

/// Relative error of the determinant 4 A C - B^2: near 0 while the words hold the footprint's length and width.
double determinant_error(const cmodel::Config& config, const cmodel::EllipseShape& words,
                         const scene::ScreenShape& footprint);

/// One record's part of a footprint: its windows and the pixels that may be inside, all relative to the centre's pixel.
struct EllipseSpan {
  cmodel::EllipseWindows windows;
  std::int32_t right = 0, bottom = 0;  ///< the last pixels of `windows` that matter, exclusive
};

/// A footprint cut into rows of windows; adjacent rows in the same columns are one span.
class EllipseSpans {
 public:
  /// `x`, `y`: the centre's words of S pi.pf, of which only the fraction matters.
  EllipseSpans(const cmodel::Config& config, const cmodel::EllipseShape& shape, std::int32_t x, std::int32_t y);
  const EllipseSpan* begin() const { return spans_.data(); }
  const EllipseSpan* end() const { return spans_.data() + count_; }

 private:
  std::array<EllipseSpan, cmodel::kEllipseWindows> spans_;
  std::size_t count_ = 0;
};

/// Half sides, in pixels, of the box that holds the footprint of these words.
struct EllipseReach {
  double x = 0.0, y = 0.0;
};
EllipseReach reach(const cmodel::Config& config, const cmodel::EllipseShape& shape);

}  // namespace fastsplat::driver
