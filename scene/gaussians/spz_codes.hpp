// SPDX-License-Identifier: Apache-2.0
// How SPZ rounds: one place for its reader and its writer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/smallest_three.hpp"
#include "scene/gaussians/stored_range.hpp"

namespace fastsplat::scene::spz {

inline constexpr std::string_view kMagic = "NGSP";
inline constexpr std::size_t kHeaderBytes = 16;                  ///< of versions 2 and 3, inside gzip
inline constexpr std::uint32_t kAntialiased = 1, kExtended = 2;  ///< flags
inline constexpr double kColourShare = 0.15;                     ///< a byte of colour is 255 (1/2 + 0.15 f_dc)

/// Bytes a Gaussian of each part, in the file's order.
struct Parts {
  std::size_t position = 9, opacity = 1, colour = 3, scale = 3, rotation = 4, harmonics = 0;
  std::array<std::size_t, 6> all() const { return {position, opacity, colour, scale, rotation, harmonics}; }
};
/// `degree`: 0..4.
inline Parts parts_of(std::uint32_t version, std::uint32_t degree) {
  return {.rotation = version == 2 ? std::size_t{3} : std::size_t{4},
          .harmonics = std::size_t{3} * ((degree + 1) * (degree + 1) - 1)};
}

/// What bytes hold, with half a step as slack.
inline constexpr double kColourReach = 0.5 * kConstantHarmonic / kColourShare;
inline constexpr StoredRange kLogScale{-10.0, 255.0 / 16.0 - 10.0, 0.5 / 16.0},
    kColour{0.5 - kColourReach, 0.5 + kColourReach, kColourReach / 255.0}, kHarmonic{-1.0, 127.0 / 128.0, 4.0 / 128.0};

inline double scale_of(std::uint32_t byte) { return std::exp(byte / 16.0 - 10.0); }
inline std::uint32_t byte_of_scale(double scale) { return nearest_step((std::log(scale) + 10.0) * 16.0, 255.0); }

inline double colour_of(std::uint32_t byte) { return (byte / 255.0 - 0.5) / kColourShare; }
inline std::uint32_t byte_of_colour(double f_dc) { return nearest_step(255.0 * (0.5 + kColourShare * f_dc), 255.0); }

inline double harmonic_of(std::uint32_t byte) { return (static_cast<double>(byte) - 128.0) / 128.0; }
/// `bits`: number of upper bits to keep of 8.
inline std::uint32_t byte_of_harmonic(double value, unsigned bits) {
  const double bucket = 1U << (8U - bits);
  const double whole = std::round(value * 128.0) + 128.0;
  const double kept = std::trunc((whole + bucket / 2.0) / bucket) * bucket;
  return static_cast<std::uint32_t>(std::clamp(kept, 0.0, 255.0));
}
/// Bits that Niantic's encoder keeps of a harmonic, so that the file compresses.
inline unsigned bits_kept(std::size_t harmonic) { return harmonic <= 3 ? 5 : 4; }

/// Versions 3 and 4: x, y, z, w; a sign and 9 bits each of all but the largest.
inline glm::dvec4 rotation_of_word(std::uint32_t word) {
  SmallestThree code{.largest = static_cast<int>(word >> 30U)};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t field = word >> (20U - 10U * static_cast<unsigned>(i));
    const double size = (field & 511U) / 511.0 / std::numbers::sqrt2;
    code.others[i] = (field & 512U) != 0 ? -size : size;
  }
  return rotation_of(code);
}
inline std::uint32_t word_of_rotation(const glm::dvec4& xyzw) {
  const SmallestThree code = smallest_three_of(xyzw);
  auto word = static_cast<std::uint32_t>(code.largest);
  for (const double value : code.others) {
    const std::uint32_t size = nearest_step(511.0 * std::abs(value) * std::numbers::sqrt2, 511.0);
    word = word << 10U | (value < 0.0 ? 512U : 0U) | size;
  }
  return word;
}
/// Version 2: x, y, z as bytes; w, not negative, completes them.
inline glm::dvec4 rotation_of_bytes(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return rotation_of(SmallestThree{.largest = 3, .others = {x / 127.5 - 1.0, y / 127.5 - 1.0, z / 127.5 - 1.0}});
}

}  // namespace fastsplat::scene::spz
