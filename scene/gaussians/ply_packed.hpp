// SPDX-License-Identifier: Apache-2.0
// Compressed PLY, as SuperSplat and splat-transform write it: 256 Gaussians share a chunk of bounds, and each is packed
// into four words relative to them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/ply_rows.hpp"
#include "scene/gaussians/stored_range.hpp"

namespace fastsplat::scene {

inline constexpr std::size_t kPackedChunk = 256;  ///< Gaussians

/// A byte as a harmonic of -4..4: 0 and 255 are the ends, the others the middles of 256 steps.
inline double packed_harmonic(double byte) {
  return 8.0 * (byte == 0.0 ? -0.5 : byte == 255.0 ? 0.5 : (byte + 0.5) / 256.0 - 0.5);
}
/// The byte whose step holds a harmonic.
inline std::uint32_t packed_byte_of_harmonic(double value) {
  return static_cast<std::uint32_t>(std::clamp(std::floor((value / 8.0 + 0.5) * 256.0), 0.0, 255.0));
}

/// What is written without clamping. The bounds of a chunk are floats, and its extremes coarsen the steps of the
/// others.
inline constexpr StoredRange kPackedLogScale{-20.0, 20.0, 1e-6}, kPackedColour{-3.5, 4.5, 1e-6},
    kPackedHarmonic{-4.0, 4.0, 0.0};
/// A compressed file, its Gaussians in Morton order, so that those of a chunk are near each other.
std::string packed_ply_bytes(const GaussianCloud& cloud);
/// How far this moves each Gaussian.
std::vector<double> packed_ply_rounding(const GaussianCloud& cloud);

/// Whether the vertices are packed words.
bool is_packed(const PlyHeader& header);

/// Reads the elements chunk, vertex and, if present, sh. Sets the degree of `to`; `rows` must be at the first element.
/// UserError (Input) for elements in another order, of other sizes or without a property.
void read_packed(const PlyHeader& header, PlyRows& rows, const std::string& where, GaussianCloud& to);

}  // namespace fastsplat::scene
