// A splat as the image sees it: where its footprint lies, its shape on the screen, what it adds.
#pragma once

#include <array>
#include <cmath>

namespace fastsplat::golden {

/// Sums that a sheet gathers per pixel: red, green, blue (premultiplied emission) and optical depth.
using Sums = std::array<double, 4>;

inline Sums scaled(const Sums& value, double share) {
  return {value[0] * share, value[1] * share, value[2] * share, value[3] * share};
}

/// What the kernel's unit disc becomes on the screen: the ellipse d^T S^-1 d < 1, S in square pixels, positive
/// definite. A footprint's second moments are Kernel::variance() * S, so blurs add to S.
struct ScreenShape {
  double xx = 0.0, xy = 0.0, yy = 0.0;

  double determinant() const { return xx * yy - xy * xy; }
};

class TexturePhase;

struct ProjectedSplat {
  double x = 0.0, y = 0.0;  ///< pixels; pixel centres are at integers
  double z = 0.0;           ///< depth of the centre, kernel units
  ScreenShape shape;
  double depth_growth = 1.0;              ///< the kernel's extent along z, relative to its own
  double reach_x = 0.0, reach_y = 0.0;    ///< pixels; the footprint's support is strictly inside
  Sums value{};                           ///< times Kernel::footprint(): what the whole splat adds to a pixel
  int sheet = 0;                          ///< axis-aligned sheet
  const TexturePhase* texture = nullptr;  ///< of the Projector; null for a plain splat
  double texture_amplitude = 0.0;
};

/// Gives the splat another shape; what it adds to the picture in all stays what it was.
inline void reshape(ProjectedSplat& splat, const ScreenShape& shape) {
  const double amplitude = std::sqrt(splat.shape.determinant() / shape.determinant());  // exactly 1 for the same shape
  for (double& value : splat.value) value *= amplitude;
  splat.shape = shape;
}

}  // namespace fastsplat::golden
