// SPDX-License-Identifier: Apache-2.0
// Unpacks a vector port: fields of equal width, packed one behind the other, each into a word of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace fastsplat::testbench {

/// Prepared for one width, so that no field's place is computed while a device runs.
class PortFields {
 public:
  /// 1 to 32 bits.
  explicit PortFields(int bits) : unpack_(kUnpack[static_cast<std::size_t>(bits) - 1]) {}

  /// Unpacks the first `count` fields of the port's words, the least significant first. Reads no more of `words` than
  /// holds them.
  void unpack(const std::uint32_t* words, std::size_t count, std::uint32_t* out) const { unpack_(words, count, out); }

 private:
  using Unpack = void (*)(const std::uint32_t*, std::size_t, std::uint32_t*);
  static constexpr std::size_t kGroup = 32;  ///< fields of any width end with a word after so many

  /// Field `index` of a group: its words and shifts are constants.
  template <std::size_t bits, std::size_t index>
  static std::uint32_t field(const std::uint32_t* words) {
    constexpr std::size_t word = index * bits / 32, shift = index * bits % 32;
    constexpr auto mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    std::uint32_t value = words[word] >> shift;
    if constexpr (shift + bits > 32) value |= words[word + 1] << (32 - shift);
    return value & mask;
  }
  template <std::size_t bits>
  static void unpack_all(const std::uint32_t* words, std::size_t count, std::uint32_t* out) {
    for (; count >= kGroup; count -= kGroup, words += bits, out += kGroup) {
      [&]<std::size_t... index>(std::index_sequence<index...>) { ((out[index] = field<bits, index>(words)), ...); }
      (std::make_index_sequence<kGroup>());
    }
    [&]<std::size_t... index>(std::index_sequence<index...>) {
      static_cast<void>(((index < count && ((out[index] = field<bits, index>(words)), true)) && ...));
    }
    (std::make_index_sequence<kGroup - 1>());
  }
  static constexpr auto kUnpack = []<std::size_t... less>(std::index_sequence<less...>) {
    return std::array<Unpack, sizeof...(less)>{unpack_all<less + 1>...};
  }
  (std::make_index_sequence<32>());

  Unpack unpack_;
};

}  // namespace fastsplat::testbench
