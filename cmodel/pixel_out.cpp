#include "cmodel/pixel_out.hpp"

#include "cmodel/narrow.hpp"

namespace fastsplat::cmodel {

std::array<std::uint32_t, 4> pixel_out(const Config& config, Mode mode, const PixelState& state, Counters& counters) {
  const bool sum = mode == Mode::Sum;
  const int frac_bits = sum ? config.sheet_frac_bits : config.composite_frac_bits;
  std::array<std::uint32_t, 4> out{};
  for (std::size_t c = 0; c < 4; ++c) {
    const bool alpha = !sum && c == 3;
    const std::int64_t value = alpha ? (std::int64_t{1} << frac_bits) - state[c] : state[c];
    const Narrowed word = narrow<Rounding::RND, Overflow::SAT>(value, frac_bits, config.pixel_format());
    counters.pixel_saturated += word.overflow ? 1 : 0;
    out[c] = static_cast<std::uint32_t>(word.word);
  }
  return out;
}

}  // namespace fastsplat::cmodel
