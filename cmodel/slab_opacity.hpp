// Slab opacity: a sheet's sums become the slab's colour and opacity (docs/numerics.md, section 6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/sheet_buffer.hpp"

namespace fastsplat::cmodel {

/// Premultiplied colour and opacity of one slab at one pixel, One.tf.
struct Slab {
  std::array<std::int64_t, 3> colour{};
  std::int64_t opacity = 0;
  int saturated = 0;  ///< how many of the four were cut to 1.0
};

class SlabOpacity {
 public:
  explicit SlabOpacity(const Config& config);

  /// G+1 words One.of of (1-exp(-tau))/tau, never increasing.
  void load(std::span<const std::uint32_t> words) { factor_.assign(words.begin(), words.end()); }

  /// (1-exp(-tau))/tau, One.of, by linear interpolation.
  std::int64_t factor(std::uint32_t tau) const;

  Slab exponential(const SheetWord& sums) const;
  Slab additive(const SheetWord& sums) const;

 private:
  Format factor_format_, slab_format_;
  int sheet_frac_bits_, remainder_bits_;
  std::vector<std::uint32_t> factor_;
};

}  // namespace fastsplat::cmodel
