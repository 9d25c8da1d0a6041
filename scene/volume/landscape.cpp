// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/landscape.hpp"

#include <algorithm>
#include <cmath>

#include "scene/volume/noise.hpp"

namespace fastsplat::volume {

float terrain(int i, int j, int k, int n) {
  constexpr std::uint32_t kSeed = 1998;
  constexpr double kHills = 3.0;       // across the volume
  constexpr double kLowest = 0.30;     // height of the lake's surface, as a share of the volume's edge
  constexpr double kHighest = 0.62;    // height of the peaks
  constexpr double kThickness = 0.08;  // of the ground: anything deeper is never visible
  const double noise = fractal_noise(kHills * i / n, kHills * j / n, 0.0, 6, kSeed);
  // Noise of several octaves stays near the middle of its range.
  const double relief = std::clamp((noise - 0.38) / 0.42, 0.0, 1.0);
  const double height = relief * relief * (3.0 - 2.0 * relief);  // 0: lake, 1: peaks
  const double above = (kLowest + (kHighest - kLowest) * height) * n - k;
  if (above > kThickness * n) return 0.0f;
  const double covered = std::clamp(above + 0.5, 0.0, 1.0);  // share of this voxel
  return static_cast<float>(covered < 1.0 ? 0.5 * covered : 0.5 + 0.5 * height);
}

float fire(int i, int j, int k, int n) {
  constexpr std::uint32_t kSeed = 1993;
  const double up = static_cast<double>(k) / (n - 1);
  const auto across = [n](int index) { return 2.0 * index / (n - 1) - 1.0; };
  // The flame sways more with height and is stretched upwards: the noise varies slowly along z.
  const double sway = 0.5 * up;
  const double x = across(i) - sway * (fractal_noise(2.5 * up, 0.0, 0.0, 3, kSeed) - 0.5);
  const double y = across(j) - sway * (fractal_noise(0.0, 2.5 * up, 0.0, 3, kSeed + 10) - 0.5);
  const double width = 1.5 * std::sqrt(up + 0.04) * (1.0 - up);
  const double body = 1.0 - std::hypot(x, y) / width;
  const double tongues = fractal_noise(3.0 * x, 3.0 * y, 2.0 * up, 4, kSeed + 20) - 0.5;
  return static_cast<float>(std::clamp(0.8 * body + (0.8 + 2.4 * up) * tongues - 0.2 * up, 0.0, 1.0));
}

}  // namespace fastsplat::volume
