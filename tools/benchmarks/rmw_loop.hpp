// SPDX-License-Identifier: Apache-2.0
// Lower bound for adding footprints: their rows are read, changed and written in the first-level cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fastsplat::bench {

/// From each place on, reads, changes and writes `rows` rows of 64 bytes, kRmwRow bytes apart, with the vectors that
/// the row kernel uses on this processor. All rows must lie inside `memory`.
void rmw(std::span<const std::uint32_t> places, std::size_t rows, std::uint16_t* memory);

inline constexpr std::size_t kRmwRow = 576;  ///< bytes: no two rows of a place share cache lines

}  // namespace fastsplat::bench
