// SPDX-License-Identifier: Apache-2.0
// Repeatable noise from integer hashing: the same bits on every machine, stateless, in any order.
#pragma once

#include <cstdint>

namespace fastsplat::volume {

/// A well-mixed word of three integers and a seed.
std::uint32_t hash_of(int x, int y, int z, std::uint32_t seed);
/// hash_of as a number in [0, 1).
double random_at(int x, int y, int z, std::uint32_t seed);
/// Value noise: random_at on the integer lattice, smooth between (cubic), in [0, 1).
double smooth_noise(double x, double y, double z, std::uint32_t seed);
/// `octaves` of smooth_noise, each of twice the frequency and half the amplitude of the one before, in [0, 1).
double fractal_noise(double x, double y, double z, int octaves, std::uint32_t seed);

}  // namespace fastsplat::volume
