// SPDX-License-Identifier: Apache-2.0
// How large a picture may be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.hpp"

namespace fastsplat::images {

/// Refuses sizes without a pixel, sides above 65536, and more than 2^31 values.
inline std::optional<ErrorParts> size_refusal(std::int64_t width, std::int64_t height, std::int64_t channels) {
  constexpr std::int64_t kLargestSide = 1 << 16, kMostValues = std::int64_t{1} << 31;
  const std::string got = std::to_string(width) + " x " + std::to_string(height) + " x " + std::to_string(channels);
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    return ErrorParts{
        {}, "unsupported image size", "sides of 1 to " + std::to_string(kLargestSide), got, {}};
  }
  if (width * height * channels > kMostValues) return ErrorParts{{}, "image too large", "at most 2^31 values", got, {}};
  return std::nullopt;
}

}  // namespace fastsplat::images
