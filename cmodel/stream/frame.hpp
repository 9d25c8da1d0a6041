// SPDX-License-Identifier: Apache-2.0
// The device's picture: raw words, as the pixel stream delivers them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastsplat::cmodel {

/// Row-major RGBA words, premultiplied, each U(int_bits).(frac_bits): value = word / 2^frac_bits.
struct Frame {
  int width = 0;
  int height = 0;
  int int_bits = 0;
  int frac_bits = 0;
  std::vector<std::uint32_t> words;  ///< width*height*4
  std::uint64_t config_hash = 0;

  std::uint32_t* pixel(int x, int y) { return &words[(static_cast<std::size_t>(y) * width + x) * 4]; }
  const std::uint32_t* pixel(int x, int y) const { return &words[(static_cast<std::size_t>(y) * width + x) * 4]; }
  bool operator==(const Frame&) const = default;
};

}  // namespace fastsplat::cmodel
