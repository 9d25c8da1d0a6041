// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <limits>

#include "base/error.hpp"
#include "scene/gaussians/axis_flips.hpp"
#include "scene/gaussians/packed_bytes.hpp"
#include "scene/gaussians/spz_codes.hpp"
#include "scene/gaussians/spz_file.hpp"

namespace fastsplat::scene {
namespace {

/// 12, as Niantic's encoder writes, or fewer if the farthest position needs the room.
int fraction_bits_for(const GaussianCloud& cloud) {
  constexpr double kReach = (1 << 23) - 1;
  double most = 0.0;
  for (const Gaussian& one : cloud.gaussians)
    for (int axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(static_cast<double>(one.position[axis])));
  int bits = 12;
  while (bits > 0 && std::round(std::ldexp(most, bits)) > kReach) --bits;
  if (std::round(std::ldexp(most, bits)) <= kReach) return bits;
  throw_input({.where = cloud.name,
               .what = "a position is too far away for .spz",
               .expected = fmt::format("within +-{:g}", kReach),
               .got = fmt::format("{:g}", most),
               .fix = "write .ply, or scale the scene"});
}

}  // namespace

std::string spz_bytes(const GaussianCloud& cloud) {
  if (cloud.gaussians.size() > std::numeric_limits<std::uint32_t>::max())
    throw_input(
        {.where = cloud.name, .what = "too many Gaussians for .spz", .expected = {}, .got = {}, .fix = "write .ply"});
  const int bits = fraction_bits_for(cloud);
  std::string positions, opacities, colours, scales, rotations, rest;
  std::vector<glm::vec3> harmonics;
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const Gaussian& one = cloud.gaussians[i];
    glm::vec3 position = one.position;
    glm::dvec4 rotation(one.rotation);
    harmonics.assign(cloud.harmonics_of(i).begin(), cloud.harmonics_of(i).end());
    flip_axes(kFlipsOfRub, position, rotation, harmonics);
    for (int axis = 0; axis < 3; ++axis) {
      const auto fixed = static_cast<std::uint32_t>(std::lround(std::ldexp(static_cast<double>(position[axis]), bits)));
      for (unsigned shift = 0; shift < 24; shift += 8) append_byte(positions, (fixed >> shift) & 0xFFU);
      append_byte(colours, spz::byte_of_colour(static_cast<double>(harmonics[0][axis])));
      append_byte(scales, spz::byte_of_scale(static_cast<double>(one.scale[axis])));
    }
    append_byte(opacities, nearest_step(255.0 * static_cast<double>(one.opacity), 255.0));
    append_word(rotations, spz::word_of_rotation({rotation[1], rotation[2], rotation[3], rotation[0]}));
    for (std::size_t k = 1; k < harmonics.size(); ++k)
      for (int c = 0; c < 3; ++c)
        append_byte(rest, spz::byte_of_harmonic(static_cast<double>(harmonics[k][c]), spz::bits_kept(k)));
  }
  std::string out(spz::kMagic);
  append_word(out, 3);
  append_word(out, static_cast<std::uint32_t>(cloud.gaussians.size()));
  append_word(out, static_cast<std::uint32_t>(cloud.degree) | static_cast<std::uint32_t>(bits) << 8U |
                       (cloud.antialiased ? spz::kAntialiased : 0U) << 16U);
  for (const std::string* part : {&positions, &opacities, &colours, &scales, &rotations, &rest}) out += *part;
  return gzip(out);
}

std::vector<double> spz_rounding(const GaussianCloud& cloud) {
  const double steps = std::ldexp(1.0, fraction_bits_for(cloud));
  std::vector<double> out;
  for (const Gaussian& one : cloud.gaussians) {
    const glm::dvec3 place(one.position);
    out.push_back(glm::distance(place, glm::round(place * steps) / steps));
  }
  return out;
}

}  // namespace fastsplat::scene
