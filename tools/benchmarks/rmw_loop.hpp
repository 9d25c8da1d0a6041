// The least that adding footprints can cost: their rows read, changed and written, in the first-level cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fastsplat::bench {

/// Reads, changes and writes `rows` rows of 64 bytes, kRmwRow bytes apart, from each place on: with the vectors that
/// the row kernel has on this processor. A place and what follows it lie inside `memory`.
void rmw(std::span<const std::uint32_t> places, std::size_t rows, std::uint16_t* memory);

inline constexpr std::size_t kRmwRow = 576;  ///< bytes: no two rows of a place fall on the same lines of the cache

}  // namespace fastsplat::bench
