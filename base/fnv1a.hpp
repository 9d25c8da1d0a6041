// SPDX-License-Identifier: Apache-2.0
// FNV-1a, the 64-bit hash of configurations, scenes and contents.
#pragma once

#include <cstdint>
#include <string_view>

namespace fastsplat {

inline constexpr std::uint64_t kFnv1aStart = 0xcbf29ce484222325U;

/// Extends `hash` by one value: a byte, as FNV-1a defines, or a 64-bit word in one step.
constexpr std::uint64_t fnv1a(std::uint64_t hash, std::uint64_t value) { return (hash ^ value) * 0x100000001b3U; }
/// Extends `hash` by the bytes of a text.
constexpr std::uint64_t fnv1a(std::uint64_t hash, std::string_view text) {
  for (const char c : text) hash = fnv1a(hash, std::uint64_t{static_cast<unsigned char>(c)});
  return hash;
}

}  // namespace fastsplat
