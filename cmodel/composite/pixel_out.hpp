// SPDX-License-Identifier: Apache-2.0
// Unit "pixel out": converts a pixel's state to output words (N-7-2).
#pragma once

#include <array>
#include <cstdint>

#include "cmodel/composite/composite_lane.hpp"
#include "cmodel/numbers/sites.hpp"
#include "cmodel/stream/stream_layout.hpp"

namespace fastsplat::cmodel {

class PixelOut {
 public:
  explicit PixelOut(const Config& config)
      : one_(std::int64_t{1} << config.composite_frac_bits), composited_(config), sum_(config) {}

  /// R, G, B, A as words of U xi.xf.
  template <class Observer>
  std::array<std::uint32_t, 4> operator()(Mode mode, const PixelState& state, Observer& observer) const {
    std::array<std::uint32_t, 4> out{};
    for (std::size_t c = 0; c < 4; ++c) {
      const std::int64_t composited = c == 3 ? one_ - state[c] : state[c];
      out[c] =
          static_cast<std::uint32_t>(mode == Mode::Sum ? sum_(state[c], observer) : composited_(composited, observer));
    }
    return out;
  }

 private:
  std::int64_t one_;  ///< 1.0 as One.tf
  NarrowAt<Site::PixelOut> composited_;
  NarrowAt<Site::PixelSum> sum_;
};

}  // namespace fastsplat::cmodel
