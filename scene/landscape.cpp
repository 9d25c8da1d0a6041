#include "scene/landscape.hpp"

#include <algorithm>
#include <cmath>

#include "scene/noise.hpp"

namespace fastsplat::scene {

float terrain(int i, int j, int k, int n) {
  constexpr std::uint32_t kSeed = 1998;
  constexpr double kHills = 3.0;       // across the volume
  constexpr double kLowest = 0.30;     // height of the lake's surface, of the volume's edge
  constexpr double kHighest = 0.62;    // of the peaks
  constexpr double kThickness = 0.08;  // of the ground: nothing below is ever seen
  const double noise = fractal_noise(kHills * i / n, kHills * j / n, 0.0, 6, kSeed);
  // Noise of several octaves keeps to the middle of its range.
  const double relief = std::clamp((noise - 0.38) / 0.42, 0.0, 1.0);
  const double height = relief * relief * (3.0 - 2.0 * relief);  // 0: lake, 1: peaks
  const double above = (kLowest + (kHighest - kLowest) * height) * n - k;
  if (above > kThickness * n) return 0.0f;
  const double covered = std::clamp(above + 0.5, 0.0, 1.0);  // of this voxel
  return static_cast<float>(covered < 1.0 ? 0.5 * covered : 0.5 + 0.5 * height);
}

}  // namespace fastsplat::scene
