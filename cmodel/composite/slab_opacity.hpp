// SPDX-License-Identifier: Apache-2.0
// Unit "slab opacity": a sheet's sums become the slab's colour and opacity (N-6-2 to N-6-5).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/splat/lane.hpp"

namespace fastsplat::cmodel {

/// Premultiplied colour (Config::slab_format()) and opacity (One.tf) of one slab at one pixel.
struct Slab {
  std::array<std::int64_t, 3> colour{};
  std::int64_t opacity = 0;
};

class SlabOpacity {
 public:
  explicit SlabOpacity(const Config& config)
      : remainder_bits_(config.opacity_remainder_bits()),
        factor_(static_cast<std::size_t>(config.opacity_segments) + 1, 0),
        fall_(config),
        colour_(config),
        opacity_(config),
        added_colour_(config),
        added_opacity_(config) {}

  /// FACTOR: G+1 words One.of of (1-exp(-tau))/tau, never increasing.
  void load(std::span<const std::uint32_t> words) { factor_.assign(words.begin(), words.end()); }

  /// (1-exp(-tau))/tau, One.of, by linear interpolation.
  template <class Observer>
  std::int64_t factor(std::uint32_t tau, Observer& observer) const {
    const std::size_t segment = static_cast<std::size_t>(std::uint64_t{tau} >> remainder_bits_);
    const std::int64_t remainder = tau & ((std::int64_t{1} << remainder_bits_) - 1);
    const std::int64_t fall = std::int64_t{factor_[segment]} - factor_[segment + 1];
    return factor_[segment] - fall_(fall * remainder, observer);
  }

  template <class Observer>
  Slab exponential(const SheetWord& sums, Observer& observer) const {
    const std::int64_t f = factor(sums[3], observer);
    Slab slab;
    for (std::size_t c = 0; c < 3; ++c) slab.colour[c] = colour_(sums[c] * f, observer);
    slab.opacity = opacity_(sums[3] * f, observer);
    return slab;
  }

  template <class Observer>
  Slab additive(const SheetWord& sums, Observer& observer) const {
    Slab slab;
    for (std::size_t c = 0; c < 3; ++c) slab.colour[c] = added_colour_(sums[c], observer);
    slab.opacity = added_opacity_(sums[3], observer);
    return slab;
  }

 private:
  int remainder_bits_;
  std::vector<std::uint32_t> factor_;
  NarrowAt<Site::Fall> fall_;
  NarrowAt<Site::SlabColour> colour_;
  NarrowAt<Site::SlabOpacity> opacity_;
  NarrowAt<Site::AddedColour> added_colour_;
  NarrowAt<Site::AddedOpacity> added_opacity_;
};

}  // namespace fastsplat::cmodel
