// SPDX-License-Identifier: Apache-2.0
// The contents of a radius set by index kind: number and range of its words (docs/numerics.md, section 4; S-table-5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

/// Largest mantissa of a scale (c, A, C); the driver's are about 2^23..2^24.
constexpr std::int64_t kLargestScale = std::int64_t{1} << 24;
/// The largest shift h.
constexpr std::int64_t kLargestShift = 62;

/// Number of words of a set with support radius `rho`, in 1/K pixel.
std::int64_t set_words(const Config& config, std::uint32_t rho);

/// Range of a word; `least` < 0: the word is two's complement.
struct WordRange {
  std::int64_t least = 0, most = 0;
};
WordRange set_word_range(const Config& config, std::size_t word);

/// The error if a squared_elliptic set breaks 4 A C >= B^2 (N-4.3-2): q would be negative somewhere. Empty for other
/// kinds.
std::optional<ErrorParts> set_violation(const Config& config, std::span<const std::uint32_t> words);

/// blit2d: number of window phases whose footprints are stored (N-4.4-3). All k, or with eightfold symmetry all but
/// mirror images of a smaller one.
std::int64_t stored_phases(const Config& config);

}  // namespace fastsplat::cmodel
