// What a radius set consists of, by the kind of index: how many words load_table brings and what each may be
// (docs/numerics.md, section 4; docs/stream.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

/// The largest mantissa of a scale: c, A and C, about 2^23..2^24.
constexpr std::int64_t kLargestScale = std::int64_t{1} << 24;
/// The largest shift h.
constexpr std::int64_t kLargestShift = 62;

/// Words of a set whose support radius is `rho` 1/K pixel.
std::int64_t set_words(const Config& config, std::uint32_t rho);

/// What a word may be; a negative `least`: the word is two's complement.
struct WordRange {
  std::int64_t least = 0, most = 0;
};
WordRange set_word_range(const Config& config, std::size_t word);

/// squared_elliptic: 4 A C >= B^2, or q would be negative somewhere. What is wrong, or nothing; other kinds have no
/// such rule.
std::optional<ErrorParts> set_violation(const Config& config, std::span<const std::uint32_t> words);

/// Window phases whose footprints are stored (blit2d): all k, or with eightfold symmetry all except mirror images of a
/// smaller one.
std::int64_t stored_phases(const Config& config);

}  // namespace fastsplat::cmodel
