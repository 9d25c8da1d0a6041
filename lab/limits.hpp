// SPDX-License-Identifier: Apache-2.0
// What a page takes and draws. The page has these numbers from the tables.
#pragma once

#include <cstdint>

namespace fastsplat::lab {

inline constexpr int kLeastSide = 16, kMostSide = 1024;  ///< of a picture, pixels
inline constexpr std::int64_t kMostVoxels = 40'000'000;
inline constexpr std::int64_t kMostGaussians = 1'000'000;  ///< of a built-in scene
inline constexpr std::int64_t kMostFileBytes = 400'000'000;

}  // namespace fastsplat::lab
