// Unit "pixel out": a pixel's state as output words (docs/numerics.md, section 7).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/compositor.hpp"
#include "cmodel/config.hpp"
#include "cmodel/counters.hpp"
#include "cmodel/stream_layout.hpp"

namespace fastsplat::cmodel {

/// R, G, B, A as words of U xi.xf.
std::array<std::uint32_t, 4> pixel_out(const Config& config, Mode mode, const PixelState& state, Counters& counters);

}  // namespace fastsplat::cmodel
