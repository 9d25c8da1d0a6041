// SPDX-License-Identifier: Apache-2.0
// The device's tables from the kernel: doubles in, loaded words out (docs/numerics.md, sections 4, 6 and 8).
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tables/quantise.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::driver {

/// The RLUT's word at `distance` along an axis, for a footprint with its edge at `rim_distance`; both in 1/k pixel.
/// `scaled` is the target of Site::Rlut.
inline std::uint32_t rlut_word(double distance, double rim_distance, const Target& scaled) {
  const auto rim = static_cast<double>(scaled.to.max);
  const bool outside = std::abs(distance) >= rim_distance;
  const double value = outside ? rim : distance * distance * rim / (rim_distance * rim_distance);
  return quantise_to<std::uint32_t>(value, scaled);
}

/// RLUT of one radius set: `radius` in pixels, `base` its first column. Words in load_table order.
cmodel::LoadTable rlut_table(const cmodel::Config& config, std::uint32_t set, double radius, std::uint32_t base);

/// F in the middle of each of the N steps of the radial table. Steps are even in squared distance, or in distance for
/// index.kind linear. An interpolated table has N+1 samples: F at the ends of the steps, scaled so that the area below
/// the lines is that below F.
std::vector<double> radial_samples(const cmodel::Config& config, const scene::Kernel& kernel);

/// Radial table, U wi.wf, quantised with its sum preserved: the largest remainders are rounded up. For index.kind
/// linear the sum by area is preserved.
cmodel::LoadTable radial_table(const cmodel::Config& config, const scene::Kernel& kernel);
/// The footprint area that entry t stands for, up to a common factor.
double radial_area(const cmodel::Config& config, std::size_t t);

/// (1-exp(-tau))/tau at the G+1 segment ends, One.of.
cmodel::LoadTable factor_table(const cmodel::Config& config);

/// PHI: cumulative slice weights One.hf at steps of 2^-zf kernel units, M+1 words, M even.
std::vector<std::uint32_t> slice_table(const cmodel::Config& config, const scene::Kernel& kernel);

}  // namespace fastsplat::driver
