// SPDX-License-Identifier: Apache-2.0
// A beat of the stream and access to its fields.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fastsplat::cmodel {

/// Eight 32-bit words: one transfer of the stream (S-record-1).
using Beat = std::array<std::uint32_t, 8>;
// All sizes in words, bytes and bits derive from Beat.
constexpr std::size_t kBeatWords = std::tuple_size_v<Beat>;
constexpr int kBeatBytes = static_cast<int>(sizeof(Beat));
constexpr int kBeatBits = 8 * kBeatBytes;
constexpr int kPixelBytes = 16;  ///< of a pixel of the output: four words

/// Bits lsb .. lsb+bits-1 of word `word`.
struct Field {
  int word;
  int lsb;
  int bits;
  bool is_signed = false;
};

constexpr std::uint32_t field_mask(const Field& field) {
  return (field.bits == 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << field.bits) - 1) << field.lsb;
}

constexpr std::int64_t get(const Beat& beat, const Field& field) {
  const std::uint32_t raw = (beat[static_cast<std::size_t>(field.word)] & field_mask(field)) >> field.lsb;
  const std::int64_t value = raw;
  return field.is_signed && (value >> (field.bits - 1)) != 0 ? value - (std::int64_t{1} << field.bits) : value;
}

/// Sets the field's bits, which must be zero before.
constexpr void put(Beat& beat, const Field& field, std::int64_t value) {
  beat[static_cast<std::size_t>(field.word)] |= (static_cast<std::uint32_t>(value) << field.lsb) & field_mask(field);
}

}  // namespace fastsplat::cmodel
