// SPDX-License-Identifier: Apache-2.0
// Little-endian numbers in the bytes of a file of Gaussians. Callers must not read beyond the end.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

namespace fastsplat::scene {

inline std::uint32_t byte_at(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }
inline std::uint32_t half_word_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) | byte_at(bytes, at + 1) << 8U;
}
inline std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return half_word_at(bytes, at) | half_word_at(bytes, at + 2) << 16U;
}
inline std::uint64_t double_word_at(std::string_view bytes, std::size_t at) {
  return word_at(bytes, at) | std::uint64_t{word_at(bytes, at + 4)} << 32U;
}
inline float float_at(std::string_view bytes, std::size_t at) { return std::bit_cast<float>(word_at(bytes, at)); }

inline void append_word(std::string& to, std::uint32_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) to.push_back(static_cast<char>((word >> shift) & 0xFFU));
}
inline void append_float(std::string& to, float value) { append_word(to, std::bit_cast<std::uint32_t>(value)); }
/// The integer of 0..most nearest to a number, halves upwards; 0 for NaN.
inline std::uint32_t nearest_step(double value, double most) {
  return value > 0.0 ? static_cast<std::uint32_t>(std::min(std::floor(value + 0.5), most)) : 0U;
}
inline void append_byte(std::string& to, std::uint32_t byte) {
  to.push_back(static_cast<char>(static_cast<unsigned char>(byte)));
}

}  // namespace fastsplat::scene
