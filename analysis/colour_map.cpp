// SPDX-License-Identifier: Apache-2.0
#include "analysis/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace fastsplat::analysis {
namespace {

Colour between(std::span<const Colour> stops, double position) {
  const double at = std::clamp(position, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double share = at - static_cast<double>(left);
  const auto mix = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::floor(a + (b - a) * share + 0.5));
  };
  const Colour& a = stops[left];
  const Colour& b = stops[left + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

}  // namespace

Colour diverging_colour(double position) {
  static constexpr std::array<Colour, 9> kStops{{{8, 42, 99},
                                                 {33, 97, 167},
                                                 {78, 151, 200},
                                                 {157, 202, 225},
                                                 {240, 240, 240},
                                                 {250, 189, 158},
                                                 {228, 113, 88},
                                                 {190, 40, 51},
                                                 {104, 4, 30}}};
  return between(kStops, 0.5 + 0.5 * position);
}

Colour heat_colour(double position) {
  static constexpr std::array<Colour, 9> kStops{{{0, 0, 0},
                                                 {30, 14, 75},
                                                 {84, 18, 110},
                                                 {135, 34, 107},
                                                 {186, 54, 84},
                                                 {226, 88, 50},
                                                 {248, 140, 16},
                                                 {249, 200, 58},
                                                 {252, 253, 190}}};
  return between(kStops, position);
}

}  // namespace fastsplat::analysis
