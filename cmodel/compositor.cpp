#include "cmodel/compositor.hpp"

#include "cmodel/narrow.hpp"

namespace fastsplat::cmodel {

bool composite(const Config& config, const Slab& slab, PixelState& pixel, Counters& counters) {
  const std::int64_t transmittance = pixel[3];
  if (transmittance < config.freeze_below) return true;
  const int tf = config.composite_frac_bits;
  const Format unit = config.transmittance_format(), colour_format = config.composited_format();
  for (std::size_t c = 0; c < 3; ++c) {
    const Narrowed light = narrow<Rounding::RND, Overflow::SAT>(transmittance * slab.colour[c], 2 * tf, unit);
    const Narrowed sum = narrow<Rounding::TRN, Overflow::SAT>(pixel[c] + light.word, tf, colour_format);
    pixel[c] = static_cast<std::uint32_t>(sum.word);
    counters.composite_saturated += sum.overflow ? 1 : 0;
  }
  const Narrowed absorbed = narrow<Rounding::RND, Overflow::SAT>(transmittance * slab.opacity, 2 * tf, unit);
  pixel[3] = static_cast<std::uint32_t>(transmittance - absorbed.word);
  return false;
}

void add(const Config& config, const SheetWord& sums, PixelState& pixel, Counters& counters) {
  const Format format = config.sheet_format();
  for (std::size_t c = 0; c < 4; ++c) {
    const std::int64_t exact = std::int64_t{pixel[c]} + sums[c];
    const Narrowed sum = narrow<Rounding::TRN, Overflow::SAT>(exact, config.sheet_frac_bits, format);
    pixel[c] = static_cast<std::uint32_t>(sum.word);
    counters.composite_saturated += sum.overflow ? 1 : 0;
  }
}

void Compositor::begin_tile(Mode mode, int width, int height) {
  mode_ = mode;
  width_ = width;
  const std::uint32_t clear = mode == Mode::Sum ? 0 : std::uint32_t{1} << config_.composite_frac_bits;
  pixels_.assign(static_cast<std::size_t>(width) * height, PixelState{0, 0, 0, clear});
}

void Compositor::step(const SheetWord& sums, int x, int y, Counters& counters) {
  PixelState& pixel = pixels_[static_cast<std::size_t>(y) * width_ + x];
  ++counters.pixels_composited;
  if (mode_ == Mode::Sum) {
    add(config_, sums, pixel, counters);
    return;
  }
  const Slab slab = mode_ == Mode::Exponential ? opacity_.exponential(sums) : opacity_.additive(sums);
  counters.opacity_saturated += static_cast<std::uint64_t>(slab.saturated);
  counters.frozen_pixels += composite(config_, slab, pixel, counters) ? 1 : 0;
}

}  // namespace fastsplat::cmodel
