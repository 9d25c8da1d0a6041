#include "cmodel/slab_opacity.hpp"

#include "cmodel/narrow.hpp"

namespace fastsplat::cmodel {

SlabOpacity::SlabOpacity(const Config& config)
    : factor_format_(config.factor_format()),
      slab_format_(config.transmittance_format()),
      sheet_frac_bits_(config.sheet_frac_bits),
      remainder_bits_(config.opacity_remainder_bits()),
      factor_(static_cast<std::size_t>(config.opacity_segments) + 1, 0) {}

std::int64_t SlabOpacity::factor(std::uint32_t tau) const {
  const std::size_t segment = static_cast<std::size_t>(std::uint64_t{tau} >> remainder_bits_);
  const std::int64_t remainder = tau & ((std::int64_t{1} << remainder_bits_) - 1);
  const std::int64_t fall = std::int64_t{factor_[segment]} - factor_[segment + 1];
  return factor_[segment] - narrow<Rounding::RND, Overflow::SAT>(
                                fall * remainder, factor_format_.frac_bits + remainder_bits_, factor_format_)
                                .word;
}

Slab SlabOpacity::exponential(const SheetWord& sums) const {
  const std::int64_t f = factor(sums[3]);
  const int frac_bits = sheet_frac_bits_ + factor_format_.frac_bits;
  Slab slab;
  for (std::size_t c = 0; c < 3; ++c) {
    const Narrowed colour = narrow<Rounding::RND, Overflow::SAT>(sums[c] * f, frac_bits, slab_format_);
    slab.colour[c] = colour.word;
    slab.saturated += colour.overflow ? 1 : 0;
  }
  const Narrowed opacity = narrow<Rounding::RND, Overflow::SAT>(sums[3] * f, frac_bits, slab_format_);
  slab.opacity = opacity.word;
  slab.saturated += opacity.overflow ? 1 : 0;
  return slab;
}

Slab SlabOpacity::additive(const SheetWord& sums) const {
  Slab slab;
  for (std::size_t c = 0; c < 3; ++c) {
    const Narrowed colour = narrow<Rounding::RND, Overflow::SAT>(sums[c], sheet_frac_bits_, slab_format_);
    slab.colour[c] = colour.word;
    slab.saturated += colour.overflow ? 1 : 0;
  }
  const Narrowed opacity = narrow<Rounding::RND, Overflow::SAT>(sums[3], sheet_frac_bits_, slab_format_);
  slab.opacity = opacity.word;
  slab.saturated += opacity.overflow ? 1 : 0;
  return slab;
}

}  // namespace fastsplat::cmodel
